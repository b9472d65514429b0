// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/ply.h"

#include <random>

#include "io/temp_folder.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using testing::error_of;
using testing::read_text;
using testing::TempFolder;
using testing::write_text;

LabelSet some_labels() {
  ClassInfo road;
  road.id = 0;
  road.name = "road";
  road.color = {128, 64, 128};
  road.planar = true;
  road.aliases = {{1, 2, 3}, {4, 5, 6}};
  ClassInfo light;
  light.id = 6;
  light.name = "traffic light";
  light.color = {250, 170, 30};
  ClassInfo car;
  car.id = 13;
  car.name = "car";
  car.color = {0, 0, 142};
  car.dynamic = true;
  ClassInfo sky;
  sky.id = 10;
  sky.name = "sky";
  sky.color = {70, 130, 180};
  sky.sky = true;
  sky.ignore = true;
  return LabelSet({road, light, sky, car});
}

MeshFile random_mesh(unsigned seed, bool with_attributes) {
  std::mt19937 random(seed);
  const std::size_t vertices = 3 + random() % 200;
  const std::size_t facets = 1 + random() % 400;
  std::uniform_real_distribution<double> coordinate(-5e5, 5e5);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  const Label ids[] = {0, 6, 10, 13, 77, kUnlabelled};
  MeshFile file;
  for (std::size_t v = 0; v < vertices; ++v) {
    file.mesh.vertices.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  }
  for (std::size_t f = 0; f < facets; ++f) {
    Triangle triangle{};
    for (std::uint32_t& v : triangle) {
      v = static_cast<std::uint32_t>(random() % vertices);
    }
    file.mesh.triangles.push_back(triangle);
    if (with_attributes) {
      file.mesh.labels.push_back(ids[random() % 6]);
      file.mesh.confidence.push_back(unit(random));
      file.mesh.views.push_back(static_cast<std::uint16_t>(random()));
    }
  }
  file.labels = some_labels();
  file.frame_id = "map";
  return file;
}

void expect_equal(const MeshFile& a, const MeshFile& b) {
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.labels, b.mesh.labels);
  EXPECT_EQ(a.mesh.confidence, b.mesh.confidence);
  EXPECT_EQ(a.mesh.views, b.mesh.views);
  EXPECT_EQ(a.frame_id, b.frame_id);
  ASSERT_EQ(a.labels.classes().size(), b.labels.classes().size());
  for (std::size_t k = 0; k < a.labels.classes().size(); ++k) {
    const ClassInfo& x = a.labels.classes()[k];
    const ClassInfo& y = b.labels.classes()[k];
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.color, y.color);
    EXPECT_EQ(x.aliases, y.aliases);
    EXPECT_EQ(std::tie(x.dynamic, x.ignore, x.planar, x.sky),
              std::tie(y.dynamic, y.ignore, y.planar, y.sky));
  }
}

// A square in the plane z = 0 whose header and body the test chooses.
std::string ascii_square(const std::string& faces,
                         const std::string& face_properties = "",
                         std::size_t face_count = 2) {
  return "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
         "property float y\nproperty float z\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\n" +
         face_properties + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces;
}

std::string read_error(const std::string& content) {
  const TempFolder folder;
  const std::string path = folder / "mesh.ply";
  write_text(path, content);
  const std::string error = error_of([&] { read_ply(path); });
  EXPECT_TRUE(error.empty() || error.find(path) != std::string::npos) << error;
  return error;
}

MeshFile read_content(const std::string& content) {
  const TempFolder folder;
  write_text(folder / "mesh.ply", content);
  return read_ply(folder / "mesh.ply");
}

TEST(Ply, RoundTripLosesNothing) {
  const TempFolder folder;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const MeshFile written = random_mesh(seed, seed % 2 == 0);
    write_ply(folder / "mesh.ply", written);
    expect_equal(read_ply(folder / "mesh.ply"), written);
  }
}

TEST(Ply, RoundTripKeepsStrangeNames) {
  const TempFolder folder;
  MeshFile written = random_mesh(1, true);
  ClassInfo strange;
  strange.id = 1;
  strange.name = " 100 %20 \xC3\x9F ";
  strange.color = {9, 9, 9};
  written.labels = LabelSet({strange});
  written.frame_id = "odd\nframe%";
  write_ply(folder / "mesh.ply", written);
  expect_equal(read_ply(folder / "mesh.ply"), written);
}

TEST(Ply, FacetColoursAreTheClassColours) {
  const TempFolder folder;
  MeshFile file = random_mesh(3, true);
  file.mesh.triangles.resize(1);
  file.mesh.labels = {13};
  file.mesh.confidence = {0.5F};
  file.mesh.views = {2};
  write_ply(folder / "mesh.ply", file);
  const std::string content = read_text(folder / "mesh.ply");
  EXPECT_EQ(content.substr(content.size() - 3), std::string("\x00\x00\x8E", 3));
}

TEST(Ply, TruncatedAnywhereIsAnError) {
  const TempFolder folder;
  MeshFile file = random_mesh(4, true);
  file.mesh.vertices.resize(3);
  file.mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
  file.mesh.labels = {0, 6};
  file.mesh.confidence = {0.1F, 0.2F};
  file.mesh.views = {1, 2};
  write_ply(folder / "mesh.ply", file);
  const std::string whole = read_text(folder / "mesh.ply");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_text(folder / "cut.ply", whole.substr(0, size));
    const std::string error = error_of([&] { read_ply(folder / "cut.ply"); });
    ASSERT_NE(error.find("cut.ply"), std::string::npos) << "cut to " << size;
  }
  EXPECT_EQ(error_of([&] { read_ply(folder / "mesh.ply"); }), "");
}

TEST(Ply, DamagedBytesNeverCrash) {
  const TempFolder folder;
  write_ply(folder / "mesh.ply", random_mesh(5, true));
  const std::string whole = read_text(folder / "mesh.ply");
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) {
      damaged[random() % (round % 2 == 0 ? 800 : whole.size())] = static_cast<char>(random());
    }
    write_text(folder / "damaged.ply", damaged);
    try {
      const MeshFile file = read_ply(folder / "damaged.ply");
      EXPECT_FALSE(file.mesh.empty());
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, 400);
}

TEST(Ply, ReadsAsciiWithUnknownPropertiesAndQuads) {
  const MeshFile file = read_content(
      "ply\r\nformat ascii 1.0\r\nobj_info none\r\nelement camera 1\r\nproperty list uchar float "
      "k\r\n"
      "property int id\r\nelement vertex 4\r\nproperty float nx\r\nproperty double x\r\n"
      "property float y\r\nproperty float z\r\nproperty uchar red\r\nelement face 2\r\n"
      "property list uchar float texcoord\r\nproperty list uchar uint vertex_index\r\n"
      "property uchar label\r\nend_header\r\n2 0.5 0.25 9\r\n"
      "7 0 0 0 255\r\n7 1e0 0 0 255\r\n7 1 +1 0 255\r\n7 0 1 -2.5 255\r\n"
      "2 0.1 0.2 4 0 1 2 3 11\r\n0 3 3 2 1 12");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
  EXPECT_EQ(file.mesh.labels, (std::vector<Label>{11, 11, 12}));
  EXPECT_EQ(file.mesh.vertices[3], Eigen::Vector3d(0, 1, -2.5));
  EXPECT_TRUE(file.mesh.confidence.empty());
  EXPECT_TRUE(file.labels.empty());
}

TEST(Ply, ReadsBigEndian) {
  std::string content =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty short y\n"
      "property double z\nelement face 1\nproperty list ushort int vertex_indices\nend_header\n";
  const char* const x_bytes[] = {"\x3F\x80\x00\x00", "\x40\x00\x00\x00", "\xC0\x40\x00\x00"};
  for (const char* x : x_bytes) {                                   // 1, 2, -3
    content += std::string(x, 4) + std::string("\xFF\xFE", 2);      // y = -2
    content += std::string("\x3F\xE0\x00\x00\x00\x00\x00\x00", 8);  // z = 0.5
  }
  content += std::string("\x00\x03\x00\x00\x00\x02\x00\x00\x00\x01\x00\x00\x00\x00", 14);
  const MeshFile file = read_content(content);
  EXPECT_EQ(file.mesh.vertices[0], Eigen::Vector3d(1, -2, 0.5));
  EXPECT_EQ(file.mesh.vertices[2], Eigen::Vector3d(-3, -2, 0.5));
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{2, 1, 0}}));
}

TEST(Ply, EachWrongFileHasItsSentence) {
  const std::string good = "3 0 1 2\n3 0 2 3\n";
  EXPECT_EQ(read_error(ascii_square(good)), "");
  const std::pair<std::string, const char*> cases[] = {
      {"", "the file is empty"},
      {"solid stl\n", "not a PLY file"},
      {"ply\nformat ascii 1.0\n", "no 'end_header'"},
      {"ply\nelement vertex 1\nend_header\n", "no 'format' line"},
      {"ply\nformat ascii 2.0\nend_header\n", "header line 2: format version '2.0'"},
      {"ply\nformat latin 1.0\nend_header\n", "unknown format 'latin'"},
      {"ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "with the count '-1'"},
      {"ply\nformat ascii 1.0\nproperty int x\nend_header\n", "a property before any element"},
      {"ply\nformat ascii 1.0\nelement face 1\nproperty long x\nend_header\n", "type 'long'"},
      {"ply\nformat ascii 1.0\nwhat is this\nend_header\n", "unknown keyword 'what'"},
      {"ply\nformat ascii 1.0\ncomment class 1 2\nend_header\n", "three colour values"},
      {"ply\nformat ascii 1.0\ncomment class x\nend_header\n", "a class id 0..65535"},
      {"ply\nformat ascii 1.0\ncomment class_alias 1 2 3 4\nend_header\n", "not listed above"},
      {"ply\nformat ascii 1.0\ncomment class 1 1 1 1 none a\ncomment class 1 2 2 2 none b\n"
       "end_header\n",
       "class list in the comments"},
      {ascii_square("3 0 1 4\n3 0 2 3\n"), "facet 0 names vertex 4"},
      {ascii_square("3 0 1 -1\n3 0 2 3\n"), "face 0 of 2: it names the vertex -1"},
      {ascii_square("3 0 1 1.5\n3 0 2 3\n"), "face 0 of 2: it names the vertex 1.5"},
      {ascii_square("3 0 1 2\n2 0 2\n"), "face 1 of 2: it has 2 corners"},
      {ascii_square("3 0 1 2\n-3 0 2 3\n"), "face 1 of 2: the length of the list"},
      {ascii_square("3 0 1 two\n3 0 2 3\n"), "'two' is no number"},
      {ascii_square("3 0 1 2\n3 0"), "face 1 of 2: truncated"},
      {ascii_square("3 0 1 2\n3 0 2 3\n", "", 3), "face 2 of 3: truncated"},
      {ascii_square(good, "", 1000000000000000000U), "truncated: the header announces"},
      {ascii_square("3 0 1 2 70000\n3 0 2 3 1\n", "property int label\n"), "out of range"},
      {ascii_square("", "", 0), "it holds no faces"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "x, y, z"},
      {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int strip\nend_header\n1 0\n",
       "no list property 'vertex_indices'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n0 nan 1\n",
       "vertex 0 of 1: a coordinate is not finite"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n0 1e999 1\n",
       "vertex 0 of 1: a coordinate is not finite"},
  };
  for (const auto& [content, expected] : cases) {
    const std::string error = read_error(content);
    EXPECT_NE(error.find(expected), std::string::npos) << expected << " / " << error;
  }
}

TEST(Ply, MissingFilesAndFoldersAreNamed) {
  const TempFolder folder;
  EXPECT_NE(error_of([&] { read_ply(folder / "no.ply"); }).find("no such file"), std::string::npos);
  EXPECT_NE(error_of([&] { read_ply(folder.path().string()); }).find("not a file"),
            std::string::npos);
}

TEST(Ply, RefusesToWriteWhatCouldNotBeRead) {
  const TempFolder folder;
  EXPECT_NE(error_of([&] { write_ply(folder / "mesh.ply", MeshFile()); }).find("no facets"),
            std::string::npos);
  MeshFile wrong = random_mesh(2, true);
  wrong.mesh.labels.pop_back();
  EXPECT_THROW(write_ply(folder / "mesh.ply", wrong), std::invalid_argument);
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace facet_mapping
