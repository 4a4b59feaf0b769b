// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "density/field_grid.h"

namespace leafhull {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Field::Field(const Lattice& lattice, double threshold)
    : lattice_(lattice), threshold_(threshold), grid_(std::make_shared<Grid>()) {}

void Field::add_bricks(std::span<const Coord> origins, std::span<const float> samples) {
  static_assert(Brick::SIZE == kBrickSamples);
  std::vector<std::unique_ptr<Brick>> bricks(origins.size());
  tbb::parallel_for(std::size_t{0}, bricks.size(), [&](std::size_t b) {
    const openvdb::Coord origin(origins[b].x, origins[b].y, origins[b].z);
    bricks[b] = std::make_unique<Brick>(openvdb::PartialCreate(), origin, 0.0f, /*active=*/true);
    bricks[b]->allocate();
    const auto values = samples.subspan(b * kBrickSamples, kBrickSamples);
    std::transform(values.begin(), values.end(), bricks[b]->buffer().data(), std::negate<>());
  });
  grid_->bricks.reserve(grid_->bricks.size() + bricks.size());
  openvdb::FloatGrid::Accessor tree = grid_->negated->getAccessor();
  for (auto& brick : bricks) {
    grid_->bricks.push_back(brick.get());
    tree.addLeaf(brick.release());
  }
}

void Field::add_inside(std::span<const InsideBlock> blocks) {
  for (const auto& [block, threshold] : blocks) {
    grid_->negated->tree().fill(samples_of(block), -inside_value(threshold), false);
  }
  inside_.insert(inside_.end(), blocks.begin(), blocks.end());
}

Field Field::at(double threshold) const {
  Field field = *this;
  field.threshold_ = threshold;
  return field;
}

void Field::raise(std::span<const BrickPart> parts, std::span<const Block> blocks) {
  own_grid();
  const float raised = -inside_value(threshold_);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    float* const values = grid_->bricks[parts[p].brick]->buffer().data();
    for (std::size_t x = 0; x < kBrickEdge; ++x) {
      for (std::uint64_t bits = parts[p].samples[x]; bits != 0; bits &= bits - 1) {
        values[64 * x + static_cast<std::size_t>(std::countr_zero(bits))] = raised;
      }
    }
  });
  std::vector<InsideBlock> inside;
  inside.reserve(blocks.size());
  for (const Block& block : blocks) inside.push_back({block, threshold_});
  add_inside(inside);
}

/// Copies a grid that at() shares. Call this before altering the grid.
void Field::own_grid() {
  if (grid_.use_count() == 1) return;
  grid_ = std::make_shared<Grid>(*grid_);
  grid_->negated = grid_->negated->deepCopy();
  tbb::parallel_for(std::size_t{0}, grid_->bricks.size(), [&](std::size_t b) {
    grid_->bricks[b] = grid_->negated->tree().probeLeaf(grid_->bricks[b]->origin());
  });
}

std::vector<Block> Field::inside() const {
  std::vector<Block> blocks;
  blocks.reserve(inside_.size());
  for (const auto& [block, threshold] : inside_) {
    if (threshold >= threshold_) blocks.push_back(block);
  }
  return blocks;
}

float Field::iso_value() const { return std::nextafter(-inside_value(threshold_), kInfinity); }

std::size_t Field::sample_count() const { return grid_->bricks.size() * kBrickSamples; }

float Field::highest() const {
  float lowest_negated = 0;
  for (const Brick* brick : grid_->bricks) {
    const float* const values = brick->buffer().data();
    lowest_negated = std::min(lowest_negated, *std::min_element(values, values + Brick::SIZE));
  }
  return -lowest_negated;
}

float inside_value(double threshold) {
  const auto value = static_cast<float>(threshold);
  return static_cast<double>(value) < threshold ? std::nextafter(value, kInfinity) : value;
}

}  // namespace leafhull
