// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/render.h"
#include "picture/artist.h"
#include "picture/check_picture.h"
#include "picture/files.h"
#include "picture/parts.h"
#include "picture/style.h"
#include "render/buffers.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

constexpr Vec3d kMiddle{10, 20, 30};

/// A cube of side 2.
std::shared_ptr<const TreeModel> cube(const std::string& mesh_name = "abstract shape") {
  TreeModel model;
  Primitive& primitive = model.primitives.emplace_back();
  primitive.mesh_name = mesh_name;
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [corner](int axis) { return corner >> axis & 1 ? 1.0f : -1.0f; };
    primitive.positions.push_back(Vec3f(kMiddle) + Vec3f(side(0), side(1), side(2)));
  }
  primitive.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  model.instances.push_back({0, "node", kIdentity});
  return std::make_shared<const TreeModel>(std::move(model));
}

Device& device() {
  static Device opened({});
  return opened;
}

/// A camera at distance 2 from the front face, which then fills half of the picture's height.
PictureOptions facing_the_cube(int width, int height) {
  PictureOptions options;
  options.width = width, options.height = height;
  options.camera = View{.eye = kMiddle + Vec3d(0, 0, 3), .target = kMiddle, .angle = 90};
  return options;
}

int count_across(const render::Buffers& buffers, int row) {
  const auto first = buffers.object.begin() + std::ptrdiff_t{row} * buffers.width;
  return static_cast<int>(std::count(first, first + buffers.width, render::Object::foliage));
}

TEST(ShapeFiles, AreKnownByTheirNames) {
  EXPECT_TRUE(is_shape(*cube()));
  EXPECT_FALSE(is_shape(*cube("crown")));
  TreeModel bare = *cube("");
  EXPECT_FALSE(is_shape(bare)) << "its node has a name";
  bare.instances.front().node_name.clear();
  EXPECT_TRUE(is_shape(bare));
  bare.materials.push_back({.name = "leaves"});
  bare.primitives.front().material = 0;
  EXPECT_FALSE(is_shape(bare));
  bare.materials.front().name.clear();
  EXPECT_TRUE(is_shape(bare)) << "a plain colour";
  bare.materials.front().alpha_mode = AlphaMode::mask;
  EXPECT_FALSE(is_shape(bare)) << "leaves cut out of cards";
  TreeModel both = *cube();
  both.primitives.push_back(cube("trunk")->primitives.front());
  both.instances.push_back({1, "node", kIdentity});
  EXPECT_FALSE(is_shape(both)) << "a tree beside its shape";
}

TEST(Views, HaveTheirAngleAlongTheHeight) {
  const Subject subject = shape_subject(cube());
  for (const auto [width, height] : {std::array{16, 16}, {64, 16}, {8, 16}}) {
    const Rendering rendering = draw(subject, facing_the_cube(width, height), device());
    EXPECT_FALSE(rendering.blank);
    const render::Buffers& seen = *rendering.buffers;
    EXPECT_EQ(count_across(seen, height / 2), std::min(width, 8));
    EXPECT_EQ(count_across(seen, 3), 0);
    EXPECT_EQ(count_across(seen, 4), std::min(width, 8));
    EXPECT_EQ(count_across(seen, 12), 0);
  }
}

TEST(Views, MayLookAway) {
  PictureOptions options = facing_the_cube(9, 9);
  std::get<View>(options.camera).target = kMiddle + Vec3d(0, 0, 9);
  const Rendering rendering = draw(shape_subject(cube()), options, device());
  EXPECT_TRUE(rendering.blank);
  EXPECT_EQ(rendering.picture.rgb, std::vector<std::uint8_t>(3 * 81, 255));
}

TEST(Subjects, HaveNoReportWhereNothingWasExtracted) {
  EXPECT_EQ(shape_subject(cube()).report(), nullptr);
}

TEST(Views, GoRoundTheMiddleOfTheSubject) {
  const Subject subject = shape_subject(cube());
  PictureOptions options = facing_the_cube(8, 8);
  options.turntable = true;
  const auto eye = [&](double turn) {
    options.turn = turn;
    const render::Camera camera = camera_of(subject.parts(), options);
    return Vec3d(camera.eye) / subject.parts().placement.scale + kMiddle;
  };
  EXPECT_NEAR(length(eye(0) - (kMiddle + Vec3d(0, 0, 3))), 0, 1e-5);
  EXPECT_NEAR(length(eye(0.25) - (kMiddle + Vec3d(3, 0, 0))), 0, 1e-5);
  EXPECT_NEAR(length(eye(0.5) - (kMiddle + Vec3d(0, 0, -3))), 0, 1e-5);
}

TEST(Views, OfADensityAreInTheUnitsOfItsFile) {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create(0.0f);
  for (int i = 0; i < 16 * 16 * 16; ++i) {  // a ball of radius 2, in voxels of half a unit
    const Vec3d p((i >> 8) - 7.5, (i >> 4 & 15) - 7.5, (i & 15) - 7.5);
    const double n = 2 - length(p) / 4;
    if (n > 0) grid->tree().setValue({i >> 8, i >> 4 & 15, i & 15}, static_cast<float>(n));
  }
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->transform().postTranslate(openvdb::Vec3d(100, 0, 0));
  const TemporaryFolder folder;
  openvdb::io::File((folder / "ball.vdb").string()).write({grid});
  PictureOptions options;
  options.width = options.height = 9;
  const Vec3d middle(100 + 3.75, 3.75, 3.75);
  for (const Surfacing surfacing : {Surfacing::direct, Surfacing::mesh}) {
    const Subject ball = field_subject(folder / "ball.vdb", 1.0, surfacing, device());
    EXPECT_EQ(ball.report(), nullptr);
    options.camera = View{.eye = middle + Vec3d(0, 0, 20), .target = middle, .angle = 30};
    EXPECT_EQ(draw(ball, options, device()).buffers->object[4 * 9 + 4], render::Object::foliage);
    std::get<View>(options.camera).target.x = 0;
    EXPECT_TRUE(draw(ball, options, device()).blank);
  }
}

TEST(Drawing, TellsHowFarItIs) {
  const Subject subject = shape_subject(cube());
  std::vector<std::pair<std::string, double>> told;
  std::size_t finished = 0, all = 0;
  const Progress progress = [&](const Advance& now) {
    told.emplace_back(now.stage, now.done);
    EXPECT_GE(now.finished, finished);
    finished = now.finished, all = now.all;
  };
  draw(subject, facing_the_cube(640, 640), device(), progress);
  const auto by_share = [](const auto& a, const auto& b) { return a.second < b.second; };
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end(), by_share));
  EXPECT_EQ(told.front(), std::pair(std::string("rays"), 0.0));
  EXPECT_EQ(told.back().first, "paint");
  EXPECT_EQ(all, 0u) << "one picture is not counted";
  const auto within = std::count_if(told.begin(), told.end(), [](const auto& step) {
    return step.first == "rays" && step.second > 0 && step.second < 0.8;
  });
  EXPECT_GE(within, 5) << "a step for each band";

  const TemporaryFolder folder;
  told.clear();
  write_pictures({&subject, 1}, {facing_the_cube(16, 16), plan_files({{folder / "a.exr"}, 3}), {}},
                 device(), progress);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end(), by_share));
  EXPECT_EQ(told.back(), std::pair(std::string("write"), 1.0));
  EXPECT_EQ(finished, 3u);
  EXPECT_EQ(all, 3u);
}

TEST(Drawing, RefusesNoSubjectAndTheBuffersOfTwo) {
  const Subject subject = shape_subject(cube());
  const std::vector<Subject> two{subject, subject};
  const TemporaryFolder folder;
  const auto write = [&](std::span<const Subject> subjects, const char* name) {
    write_pictures(subjects, {facing_the_cube(16, 16), plan_files({{folder / name}, 0}), {}},
                   device());
  };
  EXPECT_THROW(write({}, "a.png"), Error);
  EXPECT_THROW(write(two, "a.exr"), Error);
  EXPECT_TRUE(folder.names().empty());
  write(two, "a.png");
  EXPECT_FALSE(folder.names().empty());
}

TEST(Strokes, AreLeavesInPixels) {
  Subject::Parts parts;  // the scene's space is the model's
  parts.leaves = {{{0, 0, 0}, {1, 0, 0}, {0, 0.5f, 0}, 7},
                  {{2, 1, 0}, {0, 0, 0.1f}, {0.1f, 0, 0}, 8},
                  {{0, 0, 5}, {1, 0, 0}, {0, 1, 0}, 9}};
  PictureOptions options;
  options.camera = View{.eye = {0, 0, 4}, .target = {0, 0, 0}, .angle = 90};
  const render::Camera camera = camera_of(parts, options);
  const auto strokes = strokes_of(parts, camera, 800, 800);
  ASSERT_EQ(strokes.size(), 2u) << "one is behind the camera";
  const auto expect_near = [](Vec2f a, float x, float y) {
    EXPECT_NEAR(a.x, x, 1e-2f);
    EXPECT_NEAR(a.y, y, 1e-2f);
  };
  expect_near(strokes[0].centre, 400, 400);  // 100 pixels to a unit
  expect_near(strokes[0].half_major, 100, 0);
  expect_near(strokes[0].half_minor, 0, -50);
  EXPECT_EQ(strokes[0].leaf, 7u);
  EXPECT_NEAR(strokes[0].depth, 4, 1e-5f);
  expect_near(strokes[1].centre, 600, 300);
  expect_near(strokes[1].half_major, 200 * (4 / 3.9f - 1), -100 * (4 / 3.9f - 1));
}

class Trees : public testing::Test {
 protected:
  static std::shared_ptr<const TreeModel> tree() {
    static const auto model =
        std::make_shared<const TreeModel>(read_tree(std::string(LEAFHULL_EXAMPLES) + "/ash.glb"));
    return model;
  }
  static const LeafSet& leaves() {
    static const LeafSet found = find_leaves(*tree(), {});
    return found;
  }
  static Options draft(Style style = Style::painterly) {
    Options options;
    options.style = style;
    options.preset = Preset::draft;
    return options;
  }
};

TEST_F(Trees, HaveACardForEveryLeaf) {
  const Subject subject = tree_subject(tree(), leaves(), draft(), Surfacing::mesh, device());
  const Subject::Parts& parts = subject.parts();
  ASSERT_EQ(parts.leaves.size(), leaves().leaf_count);
  const LeafVertex& vertex = leaves().vertices.front();
  const std::vector<std::uint32_t>& order = leaves().order_in_file;
  const std::uint32_t in_file = order.empty() ? vertex.leaf : order[vertex.leaf];
  const auto card = std::find_if(parts.leaves.begin(), parts.leaves.end(),
                                 [&](const LeafCard& leaf) { return leaf.leaf == in_file; });
  ASSERT_NE(card, parts.leaves.end());
  const auto scale = static_cast<float>(parts.placement.scale);
  EXPECT_NEAR(length(card->half_major), vertex.radius_major * scale, 1e-6f);
  EXPECT_NEAR(length(card->half_minor), vertex.radius_minor * scale, 1e-6f);
  EXPECT_LT(length(card->centre - parts.placement(vertex.position)),
            4 * vertex.radius_major * scale);
  EXPECT_GT(subject.report()->threshold, 0);
}

TEST_F(Trees, DirectAndMeshSeeTheSame) {
  PictureOptions options;
  options.width = options.height = 160;
  const auto seen = [&](Surfacing surfacing) {
    const Subject subject = tree_subject(tree(), leaves(), draft(), surfacing, device());
    return draw(subject, options, device()).buffers;
  };
  const auto direct = seen(Surfacing::direct), mesh = seen(Surfacing::mesh);
  std::size_t same = 0, wood = 0;
  for (std::size_t i = 0; i < direct->size(); ++i) {
    same += direct->object[i] == mesh->object[i];
    wood += direct->object[i] == render::Object::wood;
  }
  EXPECT_GT(static_cast<double>(same) / static_cast<double>(direct->size()), 0.99);
  EXPECT_GT(wood, 100u);
}

/// The tree with its leaves coloured by a rule.
std::shared_ptr<TreeModel> painted(const TreeModel& tree, const LeafSet& leaves,
                                   Vec3f (*colour)(Vec3f position)) {
  auto model = std::make_shared<TreeModel>(tree);
  for (std::size_t i = 0; i < model->instances.size(); ++i) {
    if (!leaves.choice->instances[i]) continue;
    Primitive& primitive = model->primitives[model->instances[i].primitive];
    primitive.colors.clear();
    for (const Vec3f p : primitive.positions) primitive.colors.push_back(colour(p));
  }
  return model;
}

TEST_F(Trees, HaveTheColoursOfTheirLeavesWhereTheyAre) {
  const auto two = painted(*tree(), leaves(), [](Vec3f p) {
    return p.x < 0 ? Vec3f{1, 0.1f, 0.1f} : Vec3f{0.2f, 1, 0.1f};
  });
  PictureOptions options;
  options.width = options.height = 160;
  options.camera = Viewpoint::front;
  for (const Surfacing surfacing : {Surfacing::direct, Surfacing::mesh}) {
    const Subject subject = tree_subject(two, find_leaves(*two, {}), draft(), surfacing, device());
    const render::Placement& placement = subject.parts().placement;
    const auto seen = draw(subject, options, device()).buffers;
    int left = 0, right = 0, wrong = 0;
    const auto look = [&](render::Object object, Vec3f position, Vec3f color) {
      const double x = double{position.x} / placement.scale + placement.origin.x;
      const bool is_near_both = std::abs(x) < 2 * subject.report()->radius_max_model;
      if (object != render::Object::foliage || is_near_both) return;
      ++(x < 0 ? left : right);
      wrong += (color.x > color.y) != (x < 0);
    };
    for (std::size_t i = 0; i < seen->size(); ++i) {
      look(seen->object[i], seen->position[i], seen->color[i]);
    }
    for (const render::EdgeSample& sample : seen->samples) {
      look(sample.object, sample.position, sample.color);
    }
    EXPECT_GT(left, 500);
    EXPECT_GT(right, 500);
    EXPECT_EQ(wrong, 0);
  }
}

TEST_F(Trees, OfOneColourHaveItAllOver) {
  const Subject subject = tree_subject(tree(), leaves(), draft(), Surfacing::mesh, device());
  EXPECT_FALSE(subject.parts().crown_colours);
}

TEST_F(Trees, WithNeedlesHaveStrokesAwayFromTheStem) {
  auto pine = std::make_shared<TreeModel>(*tree());
  pine->path = "pine.glb";
  const Subject subject =
      tree_subject(pine, find_leaves(*pine, {}), draft(), Surfacing::mesh, device());
  const Subject::Parts& parts = subject.parts();
  EXPECT_EQ(parts.leaf_kind, LeafKind::needle);
  Vec3f middle;
  for (const LeafCard& card : parts.leaves) middle = middle + card.centre;
  middle = middle / static_cast<float>(parts.leaves.size());
  double along = 0;
  for (const LeafCard& card : parts.leaves) {
    Vec3f away = card.centre - middle;
    away.y = 0;
    along += double{dot(normalized(card.half_major), normalized(away))};
  }
  EXPECT_GT(along / static_cast<double>(parts.leaves.size()), 0.3);
}

TEST_F(Trees, StandInOneFrameTogether) {
  const Frame frame = frame_of(leaves(), 5);
  PictureOptions options;
  const auto camera = [&](Style style) {
    const Subject subject =
        tree_subject(tree(), leaves(), draft(style), Surfacing::mesh, device(), {}, frame);
    return camera_of(subject.parts(), options);
  };
  const render::Camera thin = camera(Style::paper_thin), painterly = camera(Style::painterly);
  EXPECT_EQ(thin.eye, painterly.eye);
  EXPECT_EQ(thin.tan_x, painterly.tan_x);
}

TEST(PictureSizes, AreChecked) {
  const auto expect_error = [](const PictureOptions& options, const DeviceInfo* info,
                               const std::string& part) {
    try {
      check_picture(options, info);
      ADD_FAILURE() << "no error with " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_FALSE(error.remedy().empty());
    }
  };
  PictureOptions options;
  EXPECT_NO_THROW(check_picture(options));
  for (const auto [width, height] : {std::array{0, 5}, {5, 0}, {-1, 5}, {5, kLargestSide + 1}}) {
    options.width = width, options.height = height;
    expect_error(options, nullptr, "out of range");
  }
  options = {.look = Look::watercolour, .width = 2000, .height = 1000};
  DeviceInfo gpu;
  gpu.type = "GPU";
  gpu.memory_bytes = std::size_t{1} << 27;
  expect_error(options, &gpu, "device's memory");
  try {
    check_picture(options, &gpu);
  } catch (const Error& error) {
    const std::string& remedy = error.remedy();
    ASSERT_EQ(std::sscanf(remedy.c_str() + remedy.find("--size"), "--size %dx%d", &options.width,
                          &options.height),
              2);
  }
  EXPECT_GT(options.width, 1000);
  EXPECT_NEAR(options.width, 2 * options.height, 2);
  EXPECT_NO_THROW(check_picture(options, &gpu)) << "the size that the remedy names";
  options = {.width = 2000, .height = 1000};
  EXPECT_NO_THROW(check_picture(options, &gpu)) << "shading takes none of the device's memory";
}

TEST(PictureSizes, TheSheetOfFigure17MustFitAFile) {
  const auto refusal = [](int width, int height) {
    PictureOptions options;
    options.width = width, options.height = height;
    try {
      check_figure17(options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      return std::string(error.what()) + " " + error.remedy();
    }
    return std::string();
  };
  EXPECT_EQ(refusal(64, 64), "");
  EXPECT_NE(refusal(0, 64).find("out of range"), std::string::npos);
  const std::string message = refusal(16384, 16384);
  EXPECT_NE(message.find("too large for a PNG file"), std::string::npos) << message;
  int width = 0, height = 0;
  ASSERT_EQ(std::sscanf(message.c_str() + message.find("--size"), "--size %dx%d", &width, &height),
            2);
  EXPECT_EQ(width, height);
  EXPECT_GT(width, 10000);
  EXPECT_EQ(refusal(width, height).find("PNG"), std::string::npos);
  EXPECT_NE(refusal(width + 1, height + 1).find("PNG"), std::string::npos);
}

TEST(WatercolourStyles, TakeTheirDetailFromTheCall) {
  EXPECT_EQ(watercolour_styles().front(), "classic");
  EXPECT_EQ(WatercolourStyle("wet", 0.25).keys().detail, 0.25f);
  EXPECT_NE(WatercolourStyle("wet").keys().seed, 0u);
  EXPECT_THROW(WatercolourStyle("wett"), Error);
}

}  // namespace
}  // namespace leafhull::test
