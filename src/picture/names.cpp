// SPDX-License-Identifier: Apache-2.0
#include "leafhull/render.h"

namespace leafhull {
namespace {

constexpr std::string_view kLookNames[] = {"phong", "watercolour", "normals", "depth"};
constexpr std::string_view kSurfacingNames[] = {"direct", "mesh"};
constexpr std::string_view kViewpointNames[] = {"front", "three-quarter", "top"};
constexpr std::string_view kDrawnNames[] = {"tree", "shape"};

}  // namespace

std::span<const std::string_view> names(Look) { return kLookNames; }
std::span<const std::string_view> names(Surfacing) { return kSurfacingNames; }
std::span<const std::string_view> names(Viewpoint) { return kViewpointNames; }
std::span<const std::string_view> names(Drawn) { return kDrawnNames; }

}  // namespace leafhull
