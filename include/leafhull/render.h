// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "leafhull/option_row.h"
#include "leafhull/options.h"
#include "leafhull/picture.h"
#include "leafhull/progress.h"
#include "leafhull/shape.h"
#include "leafhull/tree.h"

namespace leafhull {

enum class Look { phong, watercolour, normals, depth };
enum class Surfacing { direct, mesh };  ///< rays through the density itself, or a mesh of it
enum class Viewpoint { front, three_quarter, top };

LEAFHULL_API std::span<const std::string_view> names(Look);
LEAFHULL_API std::span<const std::string_view> names(Surfacing);
LEAFHULL_API std::span<const std::string_view> names(Viewpoint);

/// A camera, model units.
struct View {
  Vec3d eye, target;
  Vec3d up{0, 1, 0};
  double angle = 25;  ///< field of view, the picture's bottom to its top, degrees, [0.1, 170]
};

/// Reads a camera: a .json object with `eye`, `target` and perhaps `up` and `angle`, as in View, or
/// the first perspective camera in the scene of a .glb or .gltf.
/// @throws Error input: the file, the key in it and what is wrong.
LEAFHULL_API View read_view(const std::filesystem::path& file, const ReadOptions& options = {});

/// The styles that leafhull brings, the default first.
LEAFHULL_API std::span<const std::string_view> watercolour_styles();

/// How to paint a watercolour.
class WatercolourStyle {
 public:
  /// A style by its name or from a .json file; `detail`, 0..1, replaces its own where given.
  /// @throws Error usage: no such name, or a key of the file that is wrong; input: the file cannot
  /// be read.
  LEAFHULL_API explicit WatercolourStyle(const std::string& name_or_file,
                                         std::optional<double> detail = {});

  struct Keys;
  /// The part that only src/picture uses.
  const Keys& keys() const { return *keys_; }

 private:
  std::shared_ptr<const Keys> keys_;
};

/// The keys of a style file as a Markdown table: name, range, the default style's value, meaning.
LEAFHULL_API std::string watercolour_style_table();

/// What pictures show, ready to be seen from any side: foliage, and perhaps wood.
class Subject {
 public:
  struct Parts;
  explicit Subject(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

  /// The report of the extraction of a tree's shape, as far as pictures needed one; null for
  /// other subjects. Lives as long as the subject.
  LEAFHULL_API const Report* report() const;
  /// The part that only src/picture uses.
  const Parts& parts() const { return *parts_; }

 private:
  std::shared_ptr<const Parts> parts_;
};

/// The abstract shape of a tree's leaves, with all of the tree that is no leaf. `frame` is what
/// named viewpoints hold: the shape and the wood where it is empty.
/// @param leaves what find_leaves gives for `tree` and `options`.
/// @throws Error as extract does.
LEAFHULL_API Subject tree_subject(std::shared_ptr<const TreeModel> tree, const LeafSet& leaves,
                                  const Options& options, Surfacing surfacing, Device& device,
                                  const Progress& progress = {}, const Frame& frame = {});

/// A tree as its file draws it, wood and leaves with their textures. Looks apply as elsewhere,
/// except that watercolour becomes Phong shading.
/// @param choice the choice of the leaves of `like`.
/// @param like the abstract shape of the tree: pictures of both are taken from the same place.
LEAFHULL_API Subject drawn_subject(const std::shared_ptr<const TreeModel>& tree,
                                   const LeafChoice& choice, const Subject& like);

/// A shape that was written to a file.
/// @throws Error input: no extent.
LEAFHULL_API Subject shape_subject(std::shared_ptr<const TreeModel> shape);

/// Whether a file holds an abstract shape rather than a tree: its meshes are called "abstract
/// shape" as extract calls them, or nothing in it has a name or a material, as in extract's .obj.
LEAFHULL_API bool is_shape(const TreeModel& file);

/// A density that was written to a .vdb file. Its grid is called `density`, or is the only one of
/// floats; T is the grid's `threshold`, which other programs' grids lack.
/// @throws Error input: no such grid, or nothing in it; usage: no T, or one that the grid was not
/// sampled for; empty: nothing reaches T.
LEAFHULL_API Subject field_subject(const std::filesystem::path& file,
                                   std::optional<double> threshold, Surfacing surfacing,
                                   Device& device, const Progress& progress = {});

struct PictureOptions {
  Look look = Look::phong;
  int width = 1024, height = 1024;  ///< pixels, 1 to kLargestSide each
  std::variant<Viewpoint, View> camera = Viewpoint::three_quarter;
  double turn = 0;         ///< turns the camera about the subject, in whole turns
  bool turntable = false;  ///< the named viewpoint fits the subject at every turn
  std::optional<WatercolourStyle> style = {};  ///< empty: the default one
};

inline constexpr int kLargestSide = 16384;

struct Rendering {
  struct Buffers;  ///< what pixels see, for src/picture

  Picture picture;
  std::shared_ptr<const Buffers> buffers;  ///< what encode_exr takes
  bool blank = false;                      ///< nothing is in view
  std::vector<StageTime> seconds;          ///< in order, without a total
};

/// A picture of the subject: the same bytes for the same subject, options and device.
/// @param progress `done` is the share of the picture.
/// @throws Error usage: a side out of range, or more memory than there is; device.
LEAFHULL_API Rendering draw(const Subject& subject, const PictureOptions& options, Device& device,
                            const Progress& progress = {});

/// The picture and what its pixels see, as an OpenEXR file: R G B, A, Z, N, P, id, key, open,
/// foliage, wood.
LEAFHULL_API std::vector<std::uint8_t> encode_exr(const Rendering& rendering);

/// The files and times of a run of pictures.
struct PictureSummary {
  std::vector<std::filesystem::path> files;  ///< of a film's frames, only the first
  std::size_t blank = 0;                     ///< pictures with nothing in view
  std::vector<StageTime> seconds;            ///< in order, the total last
  std::vector<std::string> warnings;
};

/// Whose values a plate's rows use: leafhull's styles of leaf area, or the paper's.
enum class Plate { own, paper };

/// How a file is drawn.
enum class Drawn { tree, shape };

LEAFHULL_API std::span<const std::string_view> names(Drawn);

/// What `leafhull render` asks for, as it is typed.
struct RenderOptions : PictureOptions {
  std::vector<std::filesystem::path> files;   ///< .png and .exr; for a turntable .mp4 and .webp too
  std::optional<int> frames;                  ///< of a turntable; empty: one picture is drawn
  std::string camera_name = "three-quarter";  ///< a viewpoint, or the file of a View
  std::optional<Surfacing> surfacing;         ///< empty: a mesh of a shape, else direct
  std::string style_name;                     ///< a watercolour style or its file; empty: the first
  std::optional<double> detail;               ///< in place of the style's own
  std::optional<Drawn> drawn_as;              ///< empty: by the names in the file
  bool beside = false;                        ///< the tree itself to the left of its shape
  std::optional<Plate> figure17;              ///< a plate in place of a picture
};

LEAFHULL_API void describe(OptionLine& line, Plate value);
inline void check_value(const OptionLine&, Plate) {}

/// The sides of a picture are two members.
using RenderOptionRow =
    RowOf<RenderOptions, bool RenderOptions::*, std::vector<std::filesystem::path> RenderOptions::*,
          Look RenderOptions::*, std::pair<int RenderOptions::*, int RenderOptions::*>,
          std::string RenderOptions::*, std::optional<int> RenderOptions::*,
          std::optional<Surfacing> RenderOptions::*, std::optional<double> RenderOptions::*,
          std::optional<Drawn> RenderOptions::*, std::optional<Plate> RenderOptions::*>;

/// The options of pictures beside those of the shape.
LEAFHULL_API std::span<const RenderOptionRow> render_table();

/// Whether a file is drawn as a density: a .vdb file.
LEAFHULL_API bool is_field(const std::filesystem::path& subject);

/// The file names of pictures, by format.
struct FilePlan {
  std::vector<std::filesystem::path> png, exr;  ///< of a turntable, without frame numbers
  std::vector<std::filesystem::path> films;
  int frames = 0;                   ///< of a turntable; 0: one picture is drawn
  bool film_was_asked_for = false;  ///< by its name; otherwise films come along with the frames
  bool film_is_missing = false;     ///< a film would come along, but there is no ffmpeg
};

/// Pictures that can be drawn and written: plan_pictures() has checked them.
struct PicturePlan {
  PictureOptions picture;  ///< with its camera and its style
  FilePlan files;
  std::optional<Plate> plate;
};

/// Checks all that is asked for but the subject itself and what a device takes, and reads the
/// camera and the style.
/// @param subject the file that is drawn.
/// @throws Error usage: a value out of range, options that contradict each other, more memory than
/// the host has (and the largest size that fits), no name, an extension that is unknown or that
/// stands for a film of one picture or for the buffers of several subjects, one file twice, or the
/// subject itself; input: a camera or a style that cannot be read; output: a folder that does not
/// exist or cannot be written to, or a film without ffmpeg.
LEAFHULL_API PicturePlan plan_pictures(const RenderOptions& options,
                                       const std::filesystem::path& subject,
                                       const ReadOptions& reading = {});

/// Fails before any work is done where write_pictures() or write_figure17() would fail later.
/// @throws Error usage: the pictures need more memory than the device has, and the largest size
/// that fits.
LEAFHULL_API void check_device(const PicturePlan& plan, const DeviceInfo& device);

/// Draws and writes, one file after the other, each whole or not at all. Several subjects stand in
/// one picture, from left to right, each of the plan's size. The frames of a turntable are
/// numbered, picture-0001.png; beside them comes picture.mp4 where ffmpeg is on the PATH.
/// @param progress `done` is the share of all pictures; frames are counted.
/// @throws Error as draw does; usage: no subject, or several where the plan has a .exr file;
/// output: which file and why.
LEAFHULL_API PictureSummary write_pictures(std::span<const Subject> subjects,
                                           const PicturePlan& plan, Device& device,
                                           const Progress& progress = {});

/// Draws the plan's plate, the paper's Figure 17, and writes it: thin, fat and the previous method,
/// in Phong shading and in watercolour. Each row sets the method and the style, whose values the
/// rest of `options` overrides.
/// @param progress `done` is the share of the plate.
/// @throws Error as extract and draw do; usage: the plan has no plate; output: why.
LEAFHULL_API void write_figure17(const std::shared_ptr<const TreeModel>& tree,
                                 const LeafSet& leaves, const Options& options, Surfacing surfacing,
                                 const PicturePlan& plan, Device& device,
                                 const Progress& progress = {});

}  // namespace leafhull
