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

// Arguments as in density_vector.cl.
kernel __attribute__((reqd_work_group_size(WORK_ITEMS, 1, 1))) void density_bricks(
    global const Kernel* restrict kernels, global const int4* restrict origins,
    global const uint* restrict first, global const uint* restrict list,
    global float* restrict samples, global uint* restrict pairs) {
  local float tile[TILE]
                  [12];  // axes, then minus the centre seen from the brick's origin along them
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
      for (int a = 0; a < 3; ++a) {
        const float ax = k->axes[3 * a], ay = k->axes[3 * a + 1], az = k->axes[3 * a + 2];
        tile[item][3 * a] = ax;
        tile[item][3 * a + 1] = ay;
        tile[item][3 * a + 2] = az;
        tile[item][9 + a] = -fma(ax, cx, fma(ay, cy, az * cz));
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint t = 0; t < count; ++t) {
      local const float* a = tile[t];
      const float u = fma(a[0], x, fma(a[1], y, fma(a[2], z, a[9])));
      const float v = fma(a[3], x, fma(a[4], y, fma(a[5], z, a[10])));
      const float n = fma(a[6], x, fma(a[7], y, fma(a[8], z, a[11])));
      float w = fmax(fma(-n, n, fma(-v, v, fma(-u, u, 1.0f))), 0.0f);
      near = ADD_POWER(near, w);
      const float u4 = fma(4.0f, a[0], u), v4 = fma(4.0f, a[3], v), n4 = fma(4.0f, a[6], n);
      w = fmax(fma(-n4, n4, fma(-v4, v4, fma(-u4, u4, 1.0f))), 0.0f);
      far = ADD_POWER(far, w);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  global float* out = samples + brick * BRICK_SAMPLES;
  out[item] = near;
  out[item + WORK_ITEMS] = far;
  if (item == 0) pairs[brick] = (end - begin) * BRICK_SAMPLES;
}
