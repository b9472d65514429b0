// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/mesh_evaluation.h"

#include <regex>
#include <stdexcept>

#include "io/temp_folder.h"
#include "support/shared_data.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/evaluation/report.h"
#include "facet_mapping/io/ply.h"

namespace facet_mapping {
namespace {

using testing::TempFolder;

// A square of 2 x 2 triangles at depth z that spans x from `left` to `right`.
void add_wall(double z, double left, double right, Label label, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double y : {-10.0, 10.0}) {
    mesh.vertices.emplace_back(left, y, z);
    mesh.vertices.emplace_back(right, y, z);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first + 1, first + 3, first + 2});
  mesh.labels.insert(mesh.labels.end(), 2, label);
}

LabelSet some_labels() {
  ClassInfo wall;
  wall.id = 2;
  wall.name = "wall";
  wall.color = {200, 10, 10};
  ClassInfo sky;
  sky.id = 10;
  sky.name = "sky";
  sky.color = {70, 130, 180};
  sky.sky = true;
  return LabelSet({wall, sky});
}

// One view of 10x8 pixels at the origin; true depth 2 m in the left half, none elsewhere; true
// class 2 in rows 0 to 3, none below.
class MeshEvaluationTest : public ::testing::Test {
 protected:
  MeshEvaluationTest() {
    DatasetFrame frame;
    frame.view.camera = {10, 8, 10.0, 10.0, 4.5, 3.5};
    frame.gt_depth = folder_ / "depth.png";
    frame.gt_labels = folder_ / "labels.png";
    cv::Mat depth(8, 10, CV_16U, cv::Scalar(0));
    depth.colRange(0, 5).setTo(cv::Scalar(512));
    cv::imwrite(frame.gt_depth, depth);
    cv::Mat classes(8, 10, CV_8U, cv::Scalar(255));
    classes.rowRange(0, 4).setTo(cv::Scalar(2));
    cv::imwrite(frame.gt_labels, classes);
    dataset_.frames = {frame};
  }

  TempFolder folder_;
  Dataset dataset_;
  LabelSet labels_ = some_labels();
};

TEST_F(MeshEvaluationTest, SegmentationAgainstTheGroundTruthAtItsSize) {
  cv::Mat segmentation(4, 5, CV_8U, cv::Scalar(2));  // half the size
  segmentation.row(1).setTo(cv::Scalar(10));
  dataset_.frames[0].labels = folder_ / "segmentation.png";
  cv::imwrite(dataset_.frames[0].labels, segmentation);
  const MeshEvaluation evaluation = evaluate_segmentation(dataset_, {});
  EXPECT_EQ(evaluation.label_views, 1U);
  EXPECT_EQ(evaluation.labels.pixels, 40U);
  EXPECT_DOUBLE_EQ(evaluation.labels.accuracy, 0.5);
  EXPECT_EQ(evaluation.depth.truth_pixels, 0U);
}

TEST_F(MeshEvaluationTest, SegmentationThatIsNotThere) {
  EXPECT_THROW(evaluate_segmentation(dataset_, {}), std::runtime_error);
}

TEST_F(MeshEvaluationTest, DepthOfAWallTooFar) {
  TriangleMesh mesh;
  add_wall(2.25, -20, 20, 2, mesh);
  const MeshEvaluation evaluation = evaluate_mesh(mesh, labels_, dataset_);
  EXPECT_EQ(evaluation.facets, 2U);
  EXPECT_EQ(evaluation.depth_image_views, 1U);
  EXPECT_EQ(evaluation.scan_views, 0U);
  EXPECT_EQ(evaluation.depth.truth_pixels, 40U);
  EXPECT_DOUBLE_EQ(evaluation.depth.completeness, 1.0);
  EXPECT_NEAR(evaluation.depth.mae_m, 0.25, 1e-6);
  EXPECT_NEAR(evaluation.depth.bias_m, 0.25, 1e-6);
  ASSERT_EQ(evaluation.views.size(), 1U);
  EXPECT_NEAR(evaluation.views[0].depth.mae_m, 0.25, 1e-6);
  EXPECT_EQ(evaluation.labels.pixels, 40U);
  EXPECT_DOUBLE_EQ(evaluation.labels.accuracy, 1.0);
}

TEST_F(MeshEvaluationTest, WhatTheMeshDoesNotCoverIsMissing) {
  TriangleMesh mesh;
  // Column 1 looks along x/z = -0.35: at 2 m the wall's left border stands between columns 1 and 2.
  add_wall(2.0, -0.6, 20, 2, mesh);
  const MeshEvaluation evaluation = evaluate_mesh(mesh, labels_, dataset_);
  EXPECT_DOUBLE_EQ(evaluation.depth.completeness, 3.0 / 5.0);
  EXPECT_NEAR(evaluation.depth.mae_m, 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(evaluation.labels.accuracy, 8.0 / 10.0);
  EXPECT_EQ(evaluation.labels.predicted_pixels, 40U);
  EXPECT_EQ(evaluate_mesh(mesh, LabelSet(), dataset_).labels.predicted_pixels, 32U);
}

TEST_F(MeshEvaluationTest, AnOpenViewShowsSky) {
  cv::imwrite(dataset_.frames[0].gt_labels, cv::Mat(8, 10, CV_8U, cv::Scalar(10)));
  TriangleMesh mesh;
  add_wall(2.0, -0.6, 20, 2, mesh);
  EXPECT_DOUBLE_EQ(evaluate_mesh(mesh, labels_, dataset_).labels.accuracy, 0.2);
  EXPECT_DOUBLE_EQ(evaluate_mesh(mesh, LabelSet(), dataset_).labels.accuracy, 0.0);
}

TEST_F(MeshEvaluationTest, UnlabelledAndSkyFacetsCanBeHidden) {
  TriangleMesh mesh;
  add_wall(2.0, -20, 20, 2, mesh);
  add_wall(1.5, -20, 20, kUnlabelled, mesh);
  add_wall(1.25, -20, 20, 10, mesh);
  EvaluationOptions options;
  EXPECT_NEAR(evaluate_mesh(mesh, labels_, dataset_, options).depth.mae_m, 0.75, 1e-6);
  options.hidden.sky = true;
  EXPECT_NEAR(evaluate_mesh(mesh, labels_, dataset_, options).depth.mae_m, 0.5, 1e-6);
  options.hidden.unlabelled = true;
  const MeshEvaluation evaluation = evaluate_mesh(mesh, labels_, dataset_, options);
  EXPECT_NEAR(evaluation.depth.mae_m, 0.0, 1e-6);
  EXPECT_EQ(evaluation.facets, 2U);
}

TEST_F(MeshEvaluationTest, GapsAreHiddenUnlessAskedFor) {
  TriangleMesh mesh;
  add_wall(2.0, -20, 20, 2, mesh);
  add_wall(1.5, -20, 20, 2, mesh);
  mesh.views = {4, 4, 0, 0};
  Hidden hidden;
  EXPECT_EQ(shown_facets(mesh, labels_, hidden).views, (std::vector<std::uint16_t>{4, 4}));
  hidden.gaps = false;
  EXPECT_EQ(shown_facets(mesh, labels_, hidden).triangles.size(), 4U);
  hidden.gaps = hidden.unlabelled = hidden.sky = true;
  mesh.labels.clear();  // without labels nothing is unlabelled
  EXPECT_EQ(shown_facets(mesh, labels_, hidden).triangles.size(), 2U);
  mesh.views.clear();
  EXPECT_EQ(shown_facets(mesh, labels_, hidden).triangles.size(), 4U);
}

TEST_F(MeshEvaluationTest, GroundTruthOfAnotherSizeIsComparedAtItsOwn) {
  cv::imwrite(dataset_.frames[0].gt_depth, cv::Mat(16, 20, CV_16U, cv::Scalar(512)));
  TriangleMesh mesh;
  add_wall(2.0, -20, 20, 2, mesh);
  EXPECT_EQ(evaluate_mesh(mesh, labels_, dataset_).depth.truth_pixels, 320U);
  cv::imwrite(dataset_.frames[0].gt_depth, cv::Mat(10, 20, CV_16U, cv::Scalar(512)));
  EXPECT_THROW(evaluate_mesh(mesh, labels_, dataset_), std::invalid_argument);
}

TEST_F(MeshEvaluationTest, ScansServeWhereThereIsNoDepthImage) {
  dataset_.frames[0].gt_depth.clear();
  dataset_.frames[0].scan = folder_ / "scan.bin";
  dataset_.left_from_velo.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const float points[] = {2.0F, 0.1F, 0.1F, 0.0F};
  testing::write_text(dataset_.frames[0].scan,
                      std::string(reinterpret_cast<const char*>(points), sizeof(points)));
  TriangleMesh mesh;
  add_wall(2.5, -20, 20, 2, mesh);
  const MeshEvaluation evaluation = evaluate_mesh(mesh, labels_, dataset_);
  EXPECT_EQ(evaluation.scan_views, 1U);
  EXPECT_EQ(evaluation.depth.truth_pixels, 1U);
  EXPECT_NEAR(evaluation.depth.mae_m, 0.5, 1e-6);
}

TEST_F(MeshEvaluationTest, NothingToCompareIsAnError) {
  TriangleMesh mesh;
  add_wall(2.0, -20, 20, 2, mesh);
  EvaluationOptions options;
  options.views = {1};
  EXPECT_THROW(evaluate_mesh(mesh, labels_, dataset_, options), std::invalid_argument);
  dataset_.frames[0].gt_depth.clear();
  mesh.labels.clear();
  EXPECT_THROW(evaluate_mesh(mesh, labels_, dataset_), std::runtime_error);
}

TEST_F(MeshEvaluationTest, AreasPerClass) {
  TriangleMesh mesh;
  add_wall(2.0, 0, 1, 2, mesh);
  add_wall(3.0, 0, 3, kUnlabelled, mesh);
  const std::vector<ClassArea> areas = class_areas(mesh);
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_EQ(areas[0].id, 2);
  EXPECT_DOUBLE_EQ(areas[0].area_m2, 20.0);
  EXPECT_EQ(areas[1].id, kUnlabelled);
  EXPECT_EQ(areas[1].facets, 2U);
  EXPECT_DOUBLE_EQ(areas[1].area_m2, 60.0);
}

TEST_F(MeshEvaluationTest, SelfIntersectionsAreCountedWhenAskedFor) {
  TriangleMesh mesh;
  add_wall(2.0, -20, 20, 2, mesh);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{9.1, 8.3, 1}, {9.1, 8.3, 3}, {9.3, 8.3, 3}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.labels.push_back(2);
  EvaluationOptions options;
  const auto table = [&] {
    const std::vector<NamedEvaluation> meshes = {
        {"wall", evaluate_mesh(mesh, labels_, dataset_, options)}};
    return evaluation_table(meshes, options.depth, labels_) +
           evaluation_json(meshes, options.depth, labels_);
  };
  EXPECT_EQ(table().find("self"), std::string::npos);
  options.self_intersections = true;
  EXPECT_TRUE(std::regex_search(table(), std::regex("self-intersections +1\n")));
  EXPECT_NE(table().find("\"self_intersections\": 1,"), std::string::npos);
}

TEST_F(MeshEvaluationTest, TableAndJsonTellTheSame) {
  TriangleMesh before;
  add_wall(2.5, -20, 20, 2, before);
  TriangleMesh after;
  add_wall(2.25, -20, 20, 10, after);
  const DepthErrorOptions depth;
  const std::vector<NamedEvaluation> meshes{{"before", evaluate_mesh(before, labels_, dataset_)},
                                            {"after", evaluate_mesh(after, labels_, dataset_)}};
  const std::string table =
      std::regex_replace(evaluation_table(meshes, depth, labels_), std::regex(" +"), " ");
  EXPECT_NE(table.find("before after change"), std::string::npos) << table;
  EXPECT_NE(table.find("mean |error| 0.500 m 0.250 m -50.0 %"), std::string::npos) << table;
  EXPECT_NE(table.find("accuracy 100.0 % 0.0 % -100.0 pt"), std::string::npos) << table;
  EXPECT_NE(table.find("sky"), std::string::npos) << table;
  const std::string json = evaluation_json(meshes, depth, labels_);
  EXPECT_NE(json.find("\"mae_m\": 0.25"), std::string::npos) << json;
  EXPECT_NE(json.find("\"max_error_m\": null"), std::string::npos) << json;
}

// The figures that the data's README gives at twice this resolution.
TEST(RealEvaluation, FountainCoarseStartMesh) {
  FACET_MAPPING_DATA_OR_SKIP(folder, "fountain_p11");
  const MeshFile file = read_ply(folder + "/start_mesh_coarse.ply");
  EvaluationOptions options;
  options.depth.max_error_m = 0.1;
  options.depth.absolute_bounds_m = {0.005, 0.01, 0.02, 0.05};
  const DepthScores scores =
      evaluate_mesh(file.mesh, file.labels, read_dataset(folder), options).depth;
  EXPECT_NEAR(scores.mae_m, 0.01595, 0.0002);
  EXPECT_NEAR(scores.rms_m, 0.02328, 0.0002);
  const double published[] = {0.283, 0.478, 0.667, 0.888};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(scores.within_absolute[k], published[k], 0.005);
  }
}

}  // namespace
}  // namespace facet_mapping
