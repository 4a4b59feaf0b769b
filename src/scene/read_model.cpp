// SPDX-License-Identifier: Apache-2.0
#include "leafhull/scene.h"

namespace leafhull {

LeafSet read_model(const SceneModel& model, const LeafOptions& leaves) {
  if (!model.meshes) return find_leaves(read_tree(model.file, model.reading), leaves);
  LeafChoice choice = *model.choice;
  choice.instances.assign(model.instances.size(), true);
  return find_leaves(*model.meshes, model.instances, choice, leaves);
}

}  // namespace leafhull
