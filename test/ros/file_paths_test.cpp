// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/file_paths.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

class FilePathsTest : public testing::Test {
 protected:
  void SetUp() override {
    setenv("HOME", "/home/somebody", 1);
    unsetenv("ROS_HOME");
  }
};

TEST_F(FilePathsTest, HomeAndRelativePathsAreExpanded) {
  EXPECT_EQ(mesh_path("/tmp/a.ply"), "/tmp/a.ply");
  EXPECT_EQ(mesh_path("~/maps/a.ply"), "/home/somebody/maps/a.ply");
  EXPECT_EQ(mesh_path("a.ply"), "/home/somebody/.ros/a.ply");
  EXPECT_EQ(mesh_path("./b/../a.ply"), "/home/somebody/.ros/a.ply");
  setenv("ROS_HOME", "/data/ros", 1);
  EXPECT_EQ(mesh_path("maps/a.ply"), "/data/ros/maps/a.ply");
}

TEST_F(FilePathsTest, ExtensionIsAdded) {
  EXPECT_EQ(mesh_path("/no/folder/street"), "/no/folder/street.ply");
  EXPECT_EQ(mesh_path("/tmp/v1.2/street"), "/tmp/v1.2/street.ply");
}

TEST_F(FilePathsTest, WhatIsNoMeshFileIsRefused) {
  EXPECT_THROW(mesh_path(""), std::invalid_argument);
  EXPECT_THROW(mesh_path("/tmp"), std::invalid_argument);
  EXPECT_THROW(mesh_path("/tmp/new/"), std::invalid_argument);
  EXPECT_THROW(mesh_path("/tmp/a.obj"), std::invalid_argument);
  EXPECT_THROW(mesh_path("~other/a.ply"), std::invalid_argument);
  unsetenv("HOME");
  EXPECT_THROW(mesh_path("a.ply"), std::invalid_argument);
}

TEST_F(FilePathsTest, LabelFilesMayBePaths) {
  EXPECT_EQ(label_file_path("/data/my.yaml"), "/data/my.yaml");
  EXPECT_EQ(label_file_path("~/my.yaml"), "/home/somebody/my.yaml");
  EXPECT_THROW(label_file_path("no_such_list"), std::invalid_argument);
  EXPECT_THROW(label_file_path(""), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
