// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cli/flags.h"
#include "cli/values.h"
#include "leafhull/error.h"

namespace leafhull::cli {
namespace {

constexpr int kMostFrames = 36000;
constexpr std::string_view kKinds[] = {"tree", "shape"};

template <class Enum>
std::string_view listed() {
  static const std::string text = joined(names(Enum{}), ", ");
  return text;
}

std::string_view listed_styles() {
  static const std::string text = joined(watercolour_styles(), ", ") + ", or a .json file";
  return text;
}

void set_size(Arguments& a, const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) {
    throw Error(ErrorCode::usage, "--size '" + text + "' is not WIDTHxHEIGHT",
                "Give both in pixels, such as 1024x768.");
  }
  a.drawing.width = whole_number("--size, width", text.substr(0, cross), 1, kLargestSide);
  a.drawing.height = whole_number("--size, height", text.substr(cross + 1), 1, kLargestSide);
}

std::vector<Flag> picture_flags() {
  return {
      {.spelling = "--look",
       .value = "NAME",
       .group = "Picture",
       .range = listed<Look>(),
       .default_value = "phong",
       .help = "how it is drawn",
       .set = [](Arguments& a,
                 const std::string& text) { a.drawing.look = chosen<Look>("--look", text); }},
      {.spelling = "--size",
       .value = "WxH",
       .group = "Picture",
       .unit = "pixels",
       .range = "1 to 16384 each",
       .default_value = "1024x1024",
       .help = "width and height",
       .set = set_size},
      {.spelling = "--camera",
       .value = "NAME|FILE",
       .group = "Picture",
       .range = "front, three-quarter, top, or a .json, .glb or .gltf file",
       .default_value = "three-quarter",
       .help = "where it is seen from; a name holds all of it",
       .set = [](Arguments& a, const std::string& text) { a.camera = text; }},
      {.spelling = "--turntable",
       .value = "N",
       .group = "Picture",
       .unit = "frames",
       .range = "[1, 36000]",
       .default_value = "one picture",
       .help = "the camera goes once about the subject",
       .set =
           [](Arguments& a, const std::string& text) {
             a.pictures.frames = whole_number("--turntable", text, 1, kMostFrames);
           }},
      {.spelling = "--surface",
       .value = "NAME",
       .group = "Picture",
       .range = listed<Surfacing>(),
       .default_value = "mesh of a SHAPE, else direct",
       .help = "rays through the density itself, or a mesh",
       .set = [](Arguments& a,
                 const std::string& text) { a.surfacing = chosen<Surfacing>("--surface", text); }},
      {.spelling = "--watercolour-style",
       .value = "NAME|FILE",
       .group = "Picture",
       .range = listed_styles(),
       .default_value = watercolour_styles().front(),
       .help = "how --look watercolour paints",
       .set = [](Arguments& a, const std::string& text) { a.watercolour_style = text; }},
      {.spelling = "--detail",
       .value = "X",
       .group = "Picture",
       .range = "[0, 1]",
       .default_value = "the style's",
       .help = "how many leaf strokes a watercolour has",
       .set = [](Arguments& a,
                 const std::string& text) { a.detail = real_number("--detail", text, 0, 1); }},
      {.spelling = "--as",
       .value = "NAME",
       .group = "Picture",
       .range = "tree, shape",
       .default_value = "by the names in the file",
       .help = "whether a .glb, .gltf, .fbx or .obj file is a tree, or a shape from extract",
       .set = [](Arguments& a,
                 const std::string& text) { a.is_shape = choice("--as", text, kKinds) == 1; }},
      {.spelling = "--beside",
       .group = "Picture",
       .default_value = "off",
       .help = "draws the tree itself to the left of its shape; --size is that of each",
       .set = [](Arguments& a, const std::string&) { a.beside = true; }},
      {.spelling = "--figure17",
       .word = "paper",
       .group = "Picture",
       .range = "nothing, or paper for the paper's values",
       .default_value = "off",
       .help =
           "the paper's plate: thin, fat and the previous method, in two looks; sizes are of one",
       .set =
           [](Arguments& a, const std::string& text) {
             a.figure17 = text.empty() ? Plate::own : Plate::paper;
           }},
  };
}

}  // namespace

std::vector<Flag> render_flags() {
  std::vector<Flag> flags = {
      {.spelling = "-o,--output",
       .value = "FILE",
       .group = "Output",
       .range = ".png .exr, of a turntable .mp4 .webp",
       .default_value = "none",
       .help = "the picture, or with its buffers; a turntable numbers its frames; repeatable",
       .repeatable = true,
       .set = [](Arguments& a, const std::string& text) { a.pictures.files.emplace_back(text); }}};
  for (Flag& flag : picture_flags()) flags.push_back(std::move(flag));
  return flags;
}

}  // namespace leafhull::cli
