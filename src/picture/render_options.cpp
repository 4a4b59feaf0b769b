// SPDX-License-Identifier: Apache-2.0
// What `leafhull render` asks for: its rows, and which options contradict each other.
#include <algorithm>
#include <string>

#include "leafhull/error.h"
#include "leafhull/render.h"
#include "picture/check_picture.h"
#include "picture/files.h"
#include "text/choice.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

constexpr std::string_view kLookNames[] = {"phong", "watercolour", "normals", "depth"};
constexpr std::string_view kSurfacingNames[] = {"direct", "mesh"};
constexpr std::string_view kViewpointNames[] = {"front", "three-quarter", "top"};
constexpr std::string_view kDrawnNames[] = {"tree", "shape"};

constexpr int kMostFrames = 36000;

std::string_view listed_styles() {
  static const std::string text = joined(watercolour_styles(), ", ") + ", or a .json file";
  return text;
}

std::string_view listed_cameras() {
  static const std::string text =
      joined(names(Viewpoint{}), ", ") + ", or a .json, .glb or .gltf file";
  return text;
}

std::string_view listed_sides() {
  static const std::string text = "1 to " + std::to_string(kLargestSide) + " each";
  return text;
}

/// A viewpoint by its name, else the camera in a file.
std::variant<Viewpoint, View> camera_of(const std::string& text, const ReadOptions& reading) {
  const auto valid = names(Viewpoint{});
  const bool is_name = std::ranges::find(valid, text) != valid.end();
  if (!is_name && looks_like_file(text)) return read_view(text, reading);
  return static_cast<Viewpoint>(choice("--camera", text, valid));
}

/// A style by its name, else from a file.
WatercolourStyle style_of(const std::string& text, std::optional<double> detail) {
  const auto valid = watercolour_styles();
  if (text.empty()) return read_watercolour_style(std::string(valid.front()), detail);
  if (!looks_like_file(text)) choice("--watercolour-style", text, valid);
  return read_watercolour_style(text, detail);
}

void check_plate(const RenderOptions& options, const std::filesystem::path& subject) {
  const auto refuse = [](const std::string& what, const std::string& remedy) {
    throw Error(ErrorCode::usage, what, remedy);
  };
  if (options.frames) {
    refuse("--figure17 and --turntable contradict each other", "Give one of the two.");
  }
  if (options.look != Look::phong) {
    refuse("--figure17 sets its own looks, which contradicts --look " +
               std::string(name(options.look)),
           "Leave --look out.");
  }
  if (options.files.size() != 1 || lower_extension(options.files.front()) != ".png") {
    refuse("--figure17 writes one .png file", "Name one, such as -o figure17.png.");
  }
  if (is_field(subject) || options.drawn_as == Drawn::shape) {
    refuse("--figure17 needs the tree itself", "Give a TREE.");
  }
}

void check_beside(const RenderOptions& options, const std::filesystem::path& subject) {
  if (options.figure17) {
    throw Error(ErrorCode::usage, "--beside and --figure17 contradict each other",
                "Give one of the two.");
  }
  if (is_field(subject) || options.drawn_as == Drawn::shape) {
    throw Error(ErrorCode::usage, "--beside needs the tree itself", "Give a TREE.");
  }
}

void check_sizes(const PicturePlan& plan, const DeviceInfo* device) {
  if (plan.plate) {
    check_figure17(plan.picture, device);
  } else {
    check_picture(plan.picture, device);
  }
}

}  // namespace

std::span<const std::string_view> names(Look) { return kLookNames; }
std::span<const std::string_view> names(Surfacing) { return kSurfacingNames; }
std::span<const std::string_view> names(Viewpoint) { return kViewpointNames; }
std::span<const std::string_view> names(Drawn) { return kDrawnNames; }

void describe(OptionLine& line, Plate) { line.default_value = "off"; }

std::span<const RenderOptionRow> render_table() {
  using Row = RenderOptionRow;
  static const Row rows[] = {
      Row("Output", "output", &RenderOptions::files,
          "the picture, in .exr with its buffers; a turntable numbers its frames; repeatable",
          {.range = ".png .exr, for a turntable .mp4 .webp", .letter = 'o'}),
      Row("Picture", "look", &RenderOptions::look, "how the picture is drawn"),
      Row("Picture", "size", std::pair(&RenderOptions::width, &RenderOptions::height),
          {1, kLargestSide}, "width and height",
          {.unit = "pixels",
           .range = listed_sides(),
           .default_value = "1024x1024",
           .value = "WxH"}),
      Row("Picture", "camera", &RenderOptions::camera_name,
          "where it is seen from; a named viewpoint fits all of it",
          {.range = listed_cameras(), .value = "NAME|FILE", .choices = names(Viewpoint{})}),
      Row("Picture", "turntable", &RenderOptions::frames, {1, kMostFrames},
          "draws this many frames as the camera circles the subject once",
          {.unit = "frames", .default_value = "one picture"}),
      Row("Picture", "surface", &RenderOptions::surfacing,
          "rays through the density itself, or a mesh",
          {.default_value = "mesh for a SHAPE, else direct"}),
      Row("Picture", "watercolour-style", &RenderOptions::style_name,
          "how --look watercolour paints",
          {.range = listed_styles(),
           .default_value = watercolour_styles().front(),
           .value = "NAME|FILE",
           .choices = watercolour_styles()}),
      Row("Picture", "detail", &RenderOptions::detail, {0, 1},
          "how many leaf strokes a watercolour has", {.default_value = "the style's"}),
      Row("Picture", "as", &RenderOptions::drawn_as,
          "whether a .glb, .gltf, .fbx or .obj file is a tree, or a shape from extract",
          {.default_value = "by the names in the file"}),
      Row("Picture", "beside", &RenderOptions::beside,
          "draws the tree itself to the left of its shape; --size applies to each"),
      Row("Picture", "figure17", &RenderOptions::figure17,
          "the paper's plate: thin, fat and the previous method, in two looks; --size applies to "
          "each",
          {.range = "nothing, or paper for the paper's values", .word = "paper"}),
  };
  return rows;
}

bool is_field(const std::filesystem::path& subject) { return lower_extension(subject) == ".vdb"; }

PicturePlan plan_pictures(const RenderOptions& options, const std::filesystem::path& subject,
                          const ReadOptions& reading) {
  check_rows(render_table(), options);
  if (options.figure17) check_plate(options, subject);
  if (options.beside) check_beside(options, subject);
  PicturePlan plan{options, {}, options.figure17};
  plan.files =
      checked_files({options.files, options.frames.value_or(0)}, subject, options.beside ? 2 : 1);
  plan.picture.camera = camera_of(options.camera_name, reading);
  plan.picture.style = style_of(options.style_name, options.detail);
  check_sizes(plan, nullptr);
  return plan;
}

void check_device(const PicturePlan& plan, const DeviceInfo& device) { check_sizes(plan, &device); }

}  // namespace leafhull
