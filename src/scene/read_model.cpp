// SPDX-License-Identifier: Apache-2.0
#include "leafhull/scene.h"

namespace leafhull {

LeafSet read_model(const SceneModel& model, const LeafOptions& leaves) {
  if (model.meshes) return find_leaves(*model.meshes, model.instances, leaves);
  return find_leaves(read_tree(model.file), leaves);
}

}  // namespace leafhull
