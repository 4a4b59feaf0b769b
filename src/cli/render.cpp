// SPDX-License-Identifier: Apache-2.0
#include "leafhull/render.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/context.h"
#include "cli/flags.h"
#include "cli/help.h"
#include "cli/signals.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/output.h"
#include "leafhull/tree.h"

namespace leafhull::cli {
namespace {

namespace fs = std::filesystem;

Surfacing surfacing(const Arguments& arguments) {
  return arguments.render.surfacing.value_or(Surfacing::direct);
}

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw Error(ErrorCode::usage, what, remedy);
}

/// Options that were typed but change nothing.
std::vector<std::string> without_effect(const Arguments& arguments, bool is_tree) {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& option, const std::string& why) {
    warnings.push_back(option + " has no effect " + why);
  };
  const Look look = arguments.render.look;
  if (look != Look::watercolour && !arguments.render.figure17) {
    const std::string why = "with --look " + std::string(name(look));
    if (!arguments.render.style_name.empty()) warn("--watercolour-style", why);
    if (arguments.render.detail) warn("--detail", why);
  } else if (!is_tree && arguments.render.detail) {
    warn("--detail", "where there are no leaves");
  }
  if (is_field(arguments.operand) && arguments.render.drawn_as)
    warn("--as", "on a density from a file");
  const bool is_meshed = surfacing(arguments) == Surfacing::mesh;
  for (const OptionRow& row : option_table()) {
    if (!arguments.given.contains(row.name)) continue;
    const std::string& option = row.spelling;
    const bool of_rows = row.name == "style" || row.name == "method";
    const bool of_mesh = row.name == "snap" || row.name == "mesher" || row.name == "adaptivity";
    if (is_tree) {
      if (of_rows && arguments.render.figure17) warn(option, "on --figure17, whose rows set it");
      if (of_mesh && !is_meshed) warn(option, "without --surface mesh");
    } else if (!is_field(arguments.operand)) {
      warn(option, "on a shape that is drawn as it is");
    } else if (row.name != "threshold") {
      warn(option, "on a density from a file");
    }
  }
  return warnings;
}

/// Reads and draws, with options that have been checked.
class Run {
 public:
  Run(const Arguments& arguments, const PicturePlan& plan, Context& context)
      : arguments_(arguments), plan_(plan), context_(context) {
    context.open_device(arguments.options.falloff);
  }

  void operator()() {
    if (is_field(arguments_.operand)) {
      context_.warn(without_effect(arguments_, false));
      Device& device = open();
      const std::optional<double> threshold = arguments_.options.threshold;
      write(std::array{field_subject(arguments_.operand, threshold, surfacing(arguments_), device,
                                     context_.progress())},
            device);
      return;
    }
    const auto model = std::make_shared<const TreeModel>(context_.read(arguments_.operand));
    const std::optional<Drawn> asked = arguments_.render.drawn_as;
    const bool seems_shape = arguments_.options.leaves.empty() && is_shape(*model);
    if (asked ? *asked == Drawn::shape : seems_shape) {
      draw_shape(model);
    } else {
      draw_tree(model);
    }
  }

 private:
  Device& open() {
    Device& device = context_.device();
    check_device(plan_, device.info());
    context_.console.detail("device      " + device.info().name);
    return device;
  }

  void draw_shape(const std::shared_ptr<const TreeModel>& model) {
    const std::string file = arguments_.operand.string();
    if (const bool beside = arguments_.render.beside; beside || arguments_.render.figure17) {
      refuse(std::string(beside ? "--beside" : "--figure17") + " needs a tree, and " + file +
                 " is an abstract shape",
             "Give a TREE.");
    }
    if (arguments_.render.surfacing == Surfacing::direct) {
      refuse("--surface direct needs a density, and " + file + " is a shape of polygons",
             "Give the tree, or a .vdb file from extract --save-field.");
    }
    if (!arguments_.render.drawn_as) {
      context_.console.say("leafhull: " + file +
                           " is drawn as an abstract shape (--as tree: as a tree)");
    }
    context_.warn(without_effect(arguments_, false));
    write(std::array{shape_subject(model)}, open());
  }

  void draw_tree(const std::shared_ptr<const TreeModel>& model) {
    context_.warn(without_effect(arguments_, true));
    const LeafSet leaves = context_.find_leaves(*model, arguments_.options.leaf_options());
    Device& device = open();
    if (arguments_.render.figure17) {
      write_figure17(model, leaves, device);
      return;
    }
    const Subject subject = tree_subject(model, leaves, arguments_.options, surfacing(arguments_),
                                         device, context_.progress());
    context_.warn(subject.report()->warnings);
    std::vector<Subject> row{subject};
    if (arguments_.render.beside) {
      row.insert(row.begin(), drawn_subject(model, *leaves.choice, subject));
    }
    write(row, device);
  }

  void write_figure17(const std::shared_ptr<const TreeModel>& model, const LeafSet& leaves,
                      Device& device) {
    leafhull::write_figure17(model, leaves, arguments_.options, surfacing(arguments_), plan_,
                             device, context_.progress());
    context_.console.say("leafhull: Figure 17 of " + arguments_.operand.filename().string() +
                         " in " + seconds(context_.elapsed()) + ": " +
                         plan_.files.png.front().string());
  }

  /// Writes the shape, the last of `row`, with what stands beside it.
  void write(std::span<const Subject> row, Device& device) {
    const Report* report = row.back().report();
    if (report) {
      context_.console.detail("surface     T = " + number(report->threshold, 4) + ", " +
                              count(static_cast<std::uint64_t>(report->resolution)) +
                              " voxels of " + number(report->voxel_size, 4));
    }
    const PictureSummary summary = write_pictures(row, plan_, device, context_.progress());
    context_.warn(summary.warnings);
    const std::vector<StageTime> of_shape = report ? report->seconds : std::vector<StageTime>{};
    for (std::vector<StageTime> times : {of_shape, summary.seconds}) {
      std::erase_if(times, [](const StageTime& time) { return time.stage == "total"; });
      context_.say_stages(times, "", 10);
    }
    say_files(summary);
  }

  void say_files(const PictureSummary& summary) {
    const int frames = arguments_.render.frames.value_or(0);
    const std::string where =
        joined(summary.files, ", ", [](const fs::path& file) { return file.string(); });
    context_.console.say("leafhull: " + std::to_string(plan_.picture.width) + "x" +
                         std::to_string(plan_.picture.height) + " pixels" +
                         (frames > 0 ? ", " + std::to_string(frames) + " frames" : "") + " in " +
                         seconds(context_.elapsed()) + ": " + where);
  }

  const Arguments& arguments_;
  const PicturePlan& plan_;
  Context& context_;
};

void run_render(const Arguments& arguments) {
  Context context(arguments);
  (void)resolve(arguments.options);
  const PicturePlan plan =
      plan_pictures(arguments.render, arguments.operand, arguments.options.read_options());
  catch_signals(arguments.render.frames && !arguments.quiet
                    ? "leafhull: stopped; the frames so far are written\n"
                    : "");
  Run(arguments, plan, context)();
}

}  // namespace

std::vector<Flag> render_flags() { return flags_of(render_table(), &Arguments::render); }

Verb render_verb() {
  return {
      .name = "render",
      .summary = "pictures of a tree's abstract shape: shaded, or a watercolour",
      .about =
          "Draws the abstract shape of TREE with its trunk and branches, or what extract wrote:\n"
          "a SHAPE, or the density of a .vdb file. A turntable is a row of numbered frames, and\n"
          "a film where ffmpeg is installed.\n"
          "\n"
          "A camera file is {\"eye\": [x, y, z], \"target\": [x, y, z], \"up\": [0, 1, 0],\n"
          "\"angle\": 25} in model units and degrees from the picture's bottom to its top, or a\n"
          ".glb or .gltf file with a perspective camera.",
      .examples =
          "  leafhull render birch.glb -o birch.png --look watercolour\n"
          "  leafhull render birch.glb -o birch.png -o birch.exr --camera front --size 1920x1080\n"
          "  leafhull render birch.glb -o turn.mp4 --turntable 120 --style fat --preset fine\n"
          "  leafhull render shape.glb -o shape.png --look normals\n"
          "  leafhull render birch.glb --figure17 -o figure17.png\n",
      .takes_tree = true,
      .operand = "TREE|SHAPE|FIELD",
      .operand_help = "a .glb, .gltf, .fbx or .obj file; a density as .vdb",
      .flags =
          all_of({render_flags(), option_flags(), device_flags(), console_flags(), help_flags()}),
      .run = run_render};
}

Verb help_pictures_verb() {
  return table_verb("help-pictures", "Prints the options of pictures as Markdown tables.",
                    "  leafhull help-pictures\n",
                    [](const Arguments&) { std::cout << markdown(render_flags()); });
}

Verb help_styles_verb() {
  return table_verb("help-styles", "Prints the keys of watercolour styles as a Markdown table.",
                    "  leafhull help-styles\n",
                    [](const Arguments&) { std::cout << watercolour_style_table(); });
}

}  // namespace leafhull::cli
