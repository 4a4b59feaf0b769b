// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "render/camera.h"

namespace leafhull::render {

constexpr Vec3f operator*(Vec3f a, Vec3f b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3f mix(Vec3f a, Vec3f b, float t) { return a * (1 - t) + b * t; }

// Linear colours.
constexpr Vec3f kWhite{1, 1, 1};
constexpr Vec3f kSun{2.30f, 2.08f, 1.68f};
constexpr Vec3f kZenith{0.46f, 0.58f, 0.84f}, kHorizon{0.70f, 0.71f, 0.70f};
constexpr Vec3f kPaperBounce{0.40f, 0.38f, 0.35f};

constexpr float kSunRadius = 0.045f;  // tangent of the sun's angle: soft edges
constexpr float kSkyReach = 0.35f;    // how far leaves shade one another from the sky

/// The direction to the sun: from the upper left, before the tree.
Vec3f sun_direction(const Camera& camera);

/// The colour to draw an abstract shape in, for leaves of a known or unknown colour: their hue, a
/// little less chroma, and a lightness halfway between theirs and that of a lit mass.
Vec3f foliage_colour(const std::optional<Vec3f>& leaves);

/// Rolls highlights off below white, colour by colour.
Vec3f develop(Vec3f radiance);

/// 8 bits of sRGB. Source: IEC 61966-2-1.
std::uint8_t srgb(float linear);

}  // namespace leafhull::render
