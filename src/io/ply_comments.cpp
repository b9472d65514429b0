// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_comments.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace facet_mapping::ply {
namespace {

constexpr std::array<std::pair<const char*, bool ClassInfo::*>, 4> kFlags{{
    {"dynamic", &ClassInfo::dynamic},
    {"ignore", &ClassInfo::ignore},
    {"planar", &ClassInfo::planar},
    {"sky", &ClassInfo::sky},
}};

std::string escape(const std::string& text) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string escaped;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const bool outer_space = byte == ' ' && (k == 0 || k + 1 == text.size());
    if (byte < 0x20 || byte == 0x7F || byte == '%' || outer_space) {
      escaped += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    } else {
      escaped += text[k];
    }
  }
  return escaped;
}

std::string unescape(const std::string& text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    unsigned char byte = 0;
    const char* begin = text.data() + k + 1;
    const char* end = text.data() + std::min(k + 3, text.size());
    if (text[k] == '%' && end - begin == 2 && std::from_chars(begin, end, byte, 16).ptr == end) {
      plain += static_cast<char>(byte);
      k += 2;
    } else {
      plain += text[k];
    }
  }
  return plain;
}

std::string flags_of(const ClassInfo& info) {
  std::string flags;
  for (const auto& [name, member] : kFlags) {
    if (info.*member) {
      flags += (flags.empty() ? "" : ",") + std::string(name);
    }
  }
  return flags.empty() ? "none" : flags;
}

std::string color_words(const Rgb& color) {
  return std::to_string(color[0]) + " " + std::to_string(color[1]) + " " + std::to_string(color[2]);
}

void read_flags(const std::string& flags, ClassInfo& info) {
  std::istringstream words(flags);
  for (std::string word; std::getline(words, word, ',');) {
    for (const auto& [name, member] : kFlags) {
      info.*member = info.*member || word == name;
    }
  }
}

Rgb read_color(std::istringstream& words) {
  Rgb color{};
  for (std::uint8_t& channel : color) {
    int value = -1;
    words >> value;
    if (!words || value < 0 || value > 255) {
      throw std::runtime_error("three colour values 0..255 expected");
    }
    channel = static_cast<std::uint8_t>(value);
  }
  return color;
}

Label read_id(std::istringstream& words) {
  int id = -1;
  words >> id;
  if (!words || id < 0 || id > kUnlabelled) {
    throw std::runtime_error("a class id 0..65535 expected");
  }
  return static_cast<Label>(id);
}

// The rest of the line behind one blank.
std::string rest_of(std::istringstream& words) {
  std::string rest;
  std::getline(words, rest);
  return rest.empty() ? rest : rest.substr(1);
}

ClassInfo read_class(std::istringstream& words) {
  ClassInfo info;
  info.id = read_id(words);
  info.color = read_color(words);
  std::string flags;
  words >> flags;
  read_flags(flags, info);
  info.name = unescape(rest_of(words));
  return info;
}

void read_alias(std::istringstream& words, std::vector<ClassInfo>& classes) {
  const Label id = read_id(words);
  const Rgb color = read_color(words);
  const auto found = std::find_if(
      classes.begin(), classes.end(), [id](const ClassInfo& info) { return info.id == id; });
  if (found == classes.end()) {
    throw std::runtime_error("alias of a class that is not listed above it");
  }
  found->aliases.push_back(color);
}

void read_comment(const std::string& comment, std::string& frame, std::vector<ClassInfo>& classes) {
  std::istringstream words(comment);
  std::string keyword;
  words >> keyword;
  if (keyword == "frame_id") {
    frame = unescape(rest_of(words));
  } else if (keyword == "class") {
    classes.push_back(read_class(words));
  } else if (keyword == "class_alias") {
    read_alias(words, classes);
  }
}

}  // namespace

std::vector<std::string> write_comments(const Description& description) {
  std::vector<std::string> comments{
      "facet_mapping labelled mesh: metres, counter-clockwise seen from free space",
      "frame_id " + escape(description.frame_id)};
  for (const ClassInfo& info : description.labels.classes()) {
    const std::string id = std::to_string(info.id);
    comments.push_back("class " + id + " " + color_words(info.color) + " " + flags_of(info) + " " +
                       escape(info.name));
    for (const Rgb& alias : info.aliases) {
      comments.push_back("class_alias " + id + " " + color_words(alias));
    }
  }
  return comments;
}

Description read_comments(const std::vector<std::string>& comments) {
  Description description;
  std::vector<ClassInfo> classes;
  for (const std::string& comment : comments) {
    try {
      read_comment(comment, description.frame_id, classes);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("comment '" + comment.substr(0, 80) + "': " + error.what());
    }
  }
  if (!classes.empty()) {
    try {
      description.labels = LabelSet(std::move(classes));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error("class list in the comments: " + std::string(error.what()));
    }
  }
  return description;
}

}  // namespace facet_mapping::ply
