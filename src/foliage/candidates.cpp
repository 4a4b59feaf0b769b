// SPDX-License-Identifier: Apache-2.0
#include "foliage/candidates.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "colour/colour.h"
#include "foliage/evidence.h"

namespace leafhull {
namespace {

// What a word is worth, by where it stands.
constexpr double kMaterialName = 4, kImageName = 2, kPlaceName = 2.5, kParentName = 2;
/// A material whose name is this certain is not searched for other things.
constexpr double kSaysWhatItIs = 0.7;

/// Reads the signs of names, each once.
class NameReader {
 public:
  explicit NameReader(const TreeModel& tree) : tree_(tree), above_(tree.nodes.size()) {}

  const NameSign& sign(std::string_view name) {
    const auto [known, is_new] = signs_.try_emplace(std::string(name));
    if (is_new) known->second = read_name(name);
    return known->second;
  }

  /// The sign of the nearest ancestor whose name says something.
  const NameSign& above(int node) {
    static const NameSign nothing;
    if (node < 0 || static_cast<std::size_t>(node) >= above_.size()) return nothing;
    std::vector<int> path;
    const NameSign* found = &nothing;
    for (int at = tree_.nodes[node].parent; at >= 0; at = tree_.nodes[at].parent) {
      if (above_[at]) {
        found = above_[at];
        break;
      }
      path.push_back(at);
      const NameSign& own = sign(tree_.nodes[at].name);
      if (own.weight != 0) {
        found = &own;
        break;
      }
      if (path.size() > above_.size()) break;
    }
    for (const int at : path) above_[at] = found;
    return *found;
  }

 private:
  const TreeModel& tree_;
  std::map<std::string, NameSign> signs_;  // whose nodes stay where they are
  std::vector<const NameSign*> above_;
};

const Material* material_of(const TreeModel& tree, const Primitive& primitive) {
  return primitive.material < 0 ? nullptr : &tree.materials[primitive.material];
}

/// The stronger sign of the names of mesh and node.
const NameSign& place_sign(const NameSign& mesh, const NameSign& node) {
  return std::abs(node.weight) > std::abs(mesh.weight) ? node : mesh;
}

/// Whether a transform is finite and invertible.
bool stands(const Transform& m) {
  const double volume = dot(Vec3d{m[0][0], m[0][1], m[0][2]}, cofactors(m)[0]);
  return std::isfinite(volume + m[0][3] + m[1][3] + m[2][3]) && volume != 0;
}

/// The signs of a candidate's names.
struct Signs {
  NameSign material, image, place, above;
};

class CandidateFinder {
 public:
  CandidateFinder(const TreeModel& tree, std::span<const Instance> instances,
                  const std::vector<bool>& looked_at)
      : tree_(tree), instances_(instances), looked_at_(looked_at), names_(tree) {}

  Candidates find(const Levels& levels) {
    group(levels);
    for (const auto& [primitive, numbers] : by_primitive_) box_of(primitive, numbers);
    found_.part_of.resize(tree_.primitives.size());
    found_.welded.of.resize(tree_.primitives.size());
    look_at_all();
    drop_common_names();
    for (std::size_t i = 0; i < found_.list.size(); ++i) weigh_names(signs_[i], found_.list[i]);
    return std::move(found_);
  }

 private:
  struct Group {
    std::string_view node;
    Signs signs;
    std::vector<std::uint32_t> instances;
  };

  /// Groups the instances of each primitive whose names say the same.
  void group(const Levels& levels) {
    using Key = std::tuple<std::uint32_t, std::string_view, const NameSign*, bool>;
    std::map<Key, std::size_t> known;
    for (std::uint32_t i = 0; i < instances_.size(); ++i) {
      if (levels.coarser[i]) continue;
      const Instance& instance = instances_[i];
      const NameSign& above = names_.above(instance.node);
      const auto [entry, is_new] = known.try_emplace(
          {instance.primitive, instance.node_name, &above, looked_at_[i]}, groups_.size());
      if (is_new) {
        by_primitive_[instance.primitive].push_back(groups_.size());
        groups_.push_back({instance.node_name, signs_of(instance, above), {}});
      }
      groups_[entry->second].instances.push_back(i);
    }
  }

  Signs signs_of(const Instance& instance, const NameSign& above) {
    const Primitive& primitive = tree_.primitives[instance.primitive];
    Signs signs;
    if (const Material* material = material_of(tree_, primitive)) {
      signs.material = names_.sign(material->name);
      if (material->base_color_image >= 0) {
        const std::string& image = tree_.images[material->base_color_image].name;
        const auto slash = image.find_last_of("/\\");
        signs.image = names_.sign(std::string_view(image).substr(slash + 1));
      }
    }
    signs.place = place_sign(names_.sign(primitive.mesh_name), names_.sign(instance.node_name));
    signs.above = above;
    return signs;
  }

  void box_of(std::uint32_t primitive, const std::vector<std::size_t>& groups) {
    Box box;
    for (const Vec3f p : tree_.primitives[primitive].positions) box.include(Vec3d(p));
    if (box.empty()) return;
    for (const std::size_t g : groups) {
      for (const std::uint32_t i : groups_[g].instances) {
        if (!stands(instances_[i].to_world)) continue;
        for (int corner = 0; corner < 8; ++corner) {
          all_.include(transformed(instances_[i].to_world, {corner & 1 ? box.high.x : box.low.x,
                                                            corner & 2 ? box.high.y : box.low.y,
                                                            corner & 4 ? box.high.z : box.low.z}));
        }
      }
    }
  }

  /// The first instance with a finite, invertible transform, or simply the first.
  const Instance& first_standing(const std::vector<std::size_t>& groups) const {
    for (const std::size_t g : groups) {
      for (const std::uint32_t i : groups_[g].instances) {
        if (stands(instances_[i].to_world)) return instances_[i];
      }
    }
    return instances_[groups_[groups.front()].instances.front()];
  }

  void look_at_all() {
    using Entry = std::pair<std::uint32_t, std::vector<std::size_t>>;
    const std::vector<Entry> entries(by_primitive_.begin(), by_primitive_.end());
    std::vector<Appearances> looks(entries.size());
    tbb::parallel_for(std::size_t{0}, entries.size(),
                      [&](std::size_t i) { looks[i] = look(entries[i].first, entries[i].second); });
    for (std::size_t i = 0; i < entries.size(); ++i) {
      describe_all(entries[i].first, entries[i].second, std::move(looks[i]));
    }
  }

  Appearances look(std::uint32_t primitive, const std::vector<std::size_t>& groups) const {
    const bool is_plain = std::ranges::all_of(groups, [&](std::size_t g) {
      return std::abs(groups_[g].signs.material.weight) >= kSaysWhatItIs;
    });
    return look_at(tree_, primitive, first_standing(groups).to_world, all_,
                   is_plain ? Cutting::none : Cutting::where_it_differs);
  }

  /// Describes the parts of a primitive for each group of its instances.
  void describe_all(std::uint32_t primitive, const std::vector<std::size_t>& groups,
                    Appearances looks) {
    const Primitive& source = tree_.primitives[primitive];
    const Instance& first = first_standing(groups);
    std::vector<std::size_t> triangles(looks.parts.size());
    for (const std::uint8_t part : looks.part_of) ++triangles[part];
    if (looks.part_of.empty()) triangles.front() = source.triangles.size();

    for (const std::size_t g : groups) {
      const Group& group = groups_[g];
      for (std::size_t part = 0; part < looks.parts.size(); ++part) {
        Candidate candidate = describe(group, source, looks.parts[part], first.to_world);
        candidate.primitive = primitive;
        candidate.part = static_cast<std::uint8_t>(part);
        candidate.told.is_part = looks.parts.size() > 1;
        candidate.told.triangles = triangles[part];
        signs_.push_back(group.signs);
        found_.list.push_back(std::move(candidate));
      }
    }
    found_.part_of[primitive] = std::move(looks.part_of);
    found_.welded.of[primitive] = std::move(looks.welded);
  }

  Candidate describe(const Group& group, const Primitive& primitive, const Appearance& look,
                     const Transform& first) const {
    Candidate candidate;
    LeafCandidate& told = candidate.told;
    const Material* material = material_of(tree_, primitive);
    if (material) {
      told.material = material->name;
      told.alpha_mode = material->alpha_mode;
    }
    told.mesh = primitive.mesh_name;
    told.node = group.node;
    told.instances = group.instances.size();
    told.vertices = primitive.positions.size();
    told.area = look.area * static_cast<double>(told.instances);
    candidate.instances = group.instances;
    candidate.visible = told.area * (1 - look.cut);

    const bool unread = material && material->base_color_image >= 0 &&
                        tree_.images[material->base_color_image].empty();
    told.evidence.alpha = alpha_evidence(look, told.alpha_mode, unread);
    if (look.has_colour && !unread) {
      candidate.colour = look.colour;
      told.colour = hex_of(look.colour);
      told.evidence.colour = colour_evidence(look.colour);
    }
    told.evidence.shape = shape_evidence(look, told.instances);
    candidate.height = height_of(group, look.centre, first);
    told.evidence.place = place_evidence(candidate.height);
    return candidate;
  }

  /// The mean height of a part's middle over its instances, in the box of everything.
  double height_of(const Group& group, Vec3d centre, const Transform& first) const {
    const double rise = all_.high.y - all_.low.y;
    if (!(rise > 0)) return 0.5;
    double sum = 0;
    std::size_t count = 0;
    for (const std::uint32_t i : group.instances) {
      if (!stands(instances_[i].to_world)) continue;
      sum += centre.y + instances_[i].to_world[1][3] - first[1][3];
      ++count;
    }
    return count > 0 ? (sum / static_cast<double>(count) - all_.low.y) / rise : 0.5;
  }

  /// Drops signs that the names of all things in a file share: they tell nothing apart.
  void drop_common_names() {
    if (found_.list.size() < 2) return;
    for (NameSign Signs::*sign : {&Signs::place, &Signs::above, &Signs::image}) {
      const double first = (signs_.front().*sign).weight;
      const bool alike = std::ranges::all_of(
          signs_, [&](const Signs& signs) { return (signs.*sign).weight == first; });
      if (!alike) continue;
      for (Signs& signs : signs_) signs.*sign = {};
    }
  }

  static void weigh_names(const Signs& signs, Candidate& candidate) {
    // A material's own name says more than the names of the nodes above it.
    const double rest = 1 - 0.5 * std::abs(signs.material.weight);
    const double material = kMaterialName * signs.material.weight;
    const double image = rest * kImageName * signs.image.weight;
    const double place = rest * kPlaceName * signs.place.weight;
    const double above = signs.place.weight != 0 ? 0 : rest * kParentName * signs.above.weight;
    candidate.told.evidence.name = material + image + place + above;
    double most = 0;
    for (const auto& [sign, weight] :
         {std::pair(&signs.material, material), std::pair(&signs.image, image),
          std::pair(&signs.place, place), std::pair(&signs.above, above)}) {
      if (std::abs(weight) <= std::abs(most)) continue;
      most = weight;
      candidate.growth = sign->growth;
      candidate.told.word = sign->word;
    }
  }

  const TreeModel& tree_;
  std::span<const Instance> instances_;
  const std::vector<bool>& looked_at_;
  NameReader names_;
  std::vector<Group> groups_;
  std::map<std::uint32_t, std::vector<std::size_t>> by_primitive_;
  Box all_;
  Candidates found_;
  std::vector<Signs> signs_;  ///< by candidate
};

}  // namespace

Candidates find_candidates(const TreeModel& tree, std::span<const Instance> instances,
                           const Levels& levels, const std::vector<bool>& looked_at) {
  return CandidateFinder(tree, instances, looked_at).find(levels);
}

}  // namespace leafhull
