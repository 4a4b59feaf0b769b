// SPDX-License-Identifier: Apache-2.0
#include "leafhull/scene.h"

namespace leafhull {

LeafSet read_model(const SceneModel& model, const LeafOptions& leaves) {
  return find_leaves(model.tree ? *model.tree : read_tree(model.file), leaves);
}

}  // namespace leafhull
