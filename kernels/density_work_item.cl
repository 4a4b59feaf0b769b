// SPDX-License-Identifier: Apache-2.0
// N at the samples of a brick, for GPUs: one work-group per brick, one work-item per pair of
// samples half a brick apart, the brick's kernels staged in local memory TILE at a time.
//
// Global size: WORK_ITEMS times the number of bricks; local size WORK_ITEMS.
#include "density.clh"

#define WORK_ITEMS 256
#ifndef TILE
#define TILE 64
#endif

// A kernel as the brick sees it: U, U . (origin of the brick - centre) and its top.
typedef struct {
  float xx, xy, xz, yy, yz, zz, mx, my, mz, top;
} Near;

// The arguments are those of density_vector.cl.
kernel __attribute__((reqd_work_group_size(WORK_ITEMS, 1, 1))) void density_bricks(
    global const Kernel* restrict kernels, global const int4* restrict origins,
    global const uint* restrict first, global const uint* restrict list,
    global float* restrict samples, global uint* restrict pairs) {
  local Near tile[TILE];
  const size_t brick = get_group_id(0);
  const uint item = (uint)get_local_id(0);
  const float x = (float)(item >> 6), y = (float)(item >> 3 & 7), z = (float)(item & 7);
  const int4 origin = origins[brick];
  const uint begin = first[brick], end = first[brick + 1];
  float near = 0.0f, far = 0.0f;

  for (uint i = begin; i < end; i += TILE) {
    const uint count = min((uint)TILE, end - i);
    if (item < count) {
      global const Kernel* k = kernels + list[i + item];
      const float cx = (float)(k->cell[0] - origin.x) + k->offset[0];
      const float cy = (float)(k->cell[1] - origin.y) + k->offset[1];
      const float cz = (float)(k->cell[2] - origin.z) + k->offset[2];
      tile[item].xx = k->xx;
      tile[item].xy = k->xy;
      tile[item].xz = k->xz;
      tile[item].yy = k->yy;
      tile[item].yz = k->yz;
      tile[item].zz = k->zz;
      tile[item].mx = -fma(k->xx, cx, fma(k->xy, cy, k->xz * cz));
      tile[item].my = -fma(k->yy, cy, k->yz * cz);
      tile[item].mz = -k->zz * cz;
      tile[item].top = k->top;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint t = 0; t < count; ++t) {
      local const Near* k = tile + t;
      const float pz = fma(k->zz, z, k->mz);
      const float py = fma(k->yy, y, fma(k->yz, z, k->my));
      const float px = fma(k->xx, x, fma(k->xy, y, fma(k->xz, z, k->mx)));
      const float w_yz = fma(-pz, pz, fma(-py, py, k->top));
      float w = fmax(fma(-px, px, w_yz), 0.0f);
      near = ADD_POWER(near, w);
      const float far_x = fma(4.0f, k->xx, px);
      w = fmax(fma(-far_x, far_x, w_yz), 0.0f);
      far = ADD_POWER(far, w);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  global float* out = samples + brick * BRICK_SAMPLES;
  out[item] = near;
  out[item + WORK_ITEMS] = far;
  if (item == 0) pairs[brick] = (end - begin) * BRICK_SAMPLES;
}
