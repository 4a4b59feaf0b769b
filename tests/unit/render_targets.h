// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "render/target.h"

namespace leafhull::render {

/// Surfaces that answer ray by ray.
class SimpleTarget : public Target {
 public:
  virtual Spot closest(const Ray& ray) const = 0;

  void closest(std::span<const Ray> rays, std::span<Spot> spots) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) spots[i] = closest(rays[i]);
  }
  void occluded(std::span<const Ray> rays, float reach,
                std::span<std::uint8_t> answers) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Spot spot = closest(rays[i]);
      answers[i] = spot.hit() && spot.distance <= reach;
    }
  }
};

class Ball : public SimpleTarget {
 public:
  Ball(Vec3f centre, float radius, Object object = Object::foliage)
      : centre_(centre), radius_(radius), object_(object) {}

  using SimpleTarget::closest;
  Spot closest(const Ray& ray) const override {
    const Vec3f to_eye = ray.origin - centre_;
    const float b = dot(to_eye, ray.direction);
    const float root = b * b - dot(to_eye, to_eye) + radius_ * radius_;
    const float distance = -b - std::sqrt(std::fmax(root, 0.0f));
    if (root < 0 || distance < 1e-4f) return {};
    const Vec3f position = ray.origin + ray.direction * distance;
    const Vec3f normal = (position - centre_) / radius_;
    return {distance, object_, position, normal, normal, {0.2f, 0.4f, 0.1f}};
  }

 private:
  Vec3f centre_;
  float radius_;
  Object object_;
};

/// The infinitely high part between two x of the plane with this z, seen from larger z.
class Strip : public SimpleTarget {
 public:
  Strip(float left, float right, float z, Object object, Vec3f normal = {0, 0, 1})
      : left_(left), right_(right), z_(z), object_(object), normal_(normal) {}

  using SimpleTarget::closest;
  Spot closest(const Ray& ray) const override {
    const float distance = (z_ - ray.origin.z) / ray.direction.z;
    const Vec3f position = ray.origin + ray.direction * distance;
    if (!(distance > 1e-4f) || position.x < left_ || position.x > right_) return {};
    return {distance, object_, position, normal_, normal_, {0.5f, 0.4f, 0.3f}};
  }

 private:
  float left_, right_, z_;
  Object object_;
  Vec3f normal_;
};

/// The same openness everywhere.
class EvenSky : public Surroundings {
 public:
  explicit EvenSky(float open = 1) : open_(open) {}
  void openness(std::span<const Spot> spots, std::span<const std::uint8_t>,
                std::span<float> open) const override {
    for (std::size_t i = 0; i < spots.size(); ++i) open[i] = open_;
  }

 private:
  float open_;
};

}  // namespace leafhull::render
