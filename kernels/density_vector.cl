// SPDX-License-Identifier: Apache-2.0
// N at the samples of a brick, for CPUs: one work-item per brick, explicit vectors.
//
// A brick is eight sub-bricks of 4 x 4 x 4. Kernels are taken in runs of 32. Each is first tested
// against the eight sub-bricks at once (a float8, the bound xi_min of SPEC 5) and marked with a bit
// in those that it reaches. Then every sub-brick sums its kernels; a float16 holds 4 x 4 samples of
// y and z. Sums run in the order of the list.
//
// Global size: the number of bricks; local size 1.
#include "density.clh"
#include "marks.clh"

#define SUB_BRICKS 8
#define SUB_BRICK_SAMPLES 64

// Half the extent of a sub-brick's samples, widened by the rounding of a position.
#define HALF 1.500015f

typedef struct {
  float8 from_kernel[RUN][3];  // U . (centre of each sub-brick - centre of the kernel)
  uint reached[SUB_BRICKS];    // a bit for each kernel that reaches it, the highest for the first
} Run;

static void test_run(global const Kernel* kernels, global const uint* list, int count, int4 origin,
                     Run* run) {
  const float8 qx = (float8)(1.5f, 1.5f, 1.5f, 1.5f, 5.5f, 5.5f, 5.5f, 5.5f);
  const float8 qy = (float8)(1.5f, 1.5f, 5.5f, 5.5f, 1.5f, 1.5f, 5.5f, 5.5f);
  const float8 qz = (float8)(1.5f, 5.5f, 1.5f, 5.5f, 1.5f, 5.5f, 1.5f, 5.5f);
  uint8 reached = 0;
  for (int i = 0; i < count; ++i) {
    global const Kernel* k = kernels + list[i];
    const float8 dx = qx - ((float)(k->cell[0] - origin.x) + k->offset[0]);
    const float8 dy = qy - ((float)(k->cell[1] - origin.y) + k->offset[1]);
    const float8 dz = qz - ((float)(k->cell[2] - origin.z) + k->offset[2]);
    const float8 mx = fma((float8)(k->xx), dx, fma((float8)(k->xy), dy, k->xz * dz));
    const float8 my = fma((float8)(k->yy), dy, k->yz * dz);
    const float8 mz = k->zz * dz;
    run->from_kernel[i][0] = mx;
    run->from_kernel[i][1] = my;
    run->from_kernel[i][2] = mz;
    const float8 near_x = fmax(fabs(mx) - HALF * (k->xx + fabs(k->xy) + fabs(k->xz)), 0.0f);
    const float8 near_y = fmax(fabs(my) - HALF * (k->yy + fabs(k->yz)), 0.0f);
    const float8 near_z = fmax(fabs(mz) - HALF * k->zz, 0.0f);
    const float8 least = fma(near_x, near_x, fma(near_y, near_y, near_z * near_z));
    reached |= as_uint8(least < XI_SLACK * k->top) & (FIRST_OF_RUN >> i);
  }
  vstore8(reached, 0, run->reached);
}

// Adds the kernels that reach a sub-brick to its samples n, x by x.
static void sum_run(global const Kernel* kernels, global const uint* list, const Run* run,
                    int sub_brick, float16* n) {
  const float16 y = (float16)(-1.5f, -1.5f, -1.5f, -1.5f, -0.5f, -0.5f, -0.5f, -0.5f,  //
                              0.5f, 0.5f, 0.5f, 0.5f, 1.5f, 1.5f, 1.5f, 1.5f);
  const float16 z = (float16)(-1.5f, -0.5f, 0.5f, 1.5f, -1.5f, -0.5f, 0.5f, 1.5f,  //
                              -1.5f, -0.5f, 0.5f, 1.5f, -1.5f, -0.5f, 0.5f, 1.5f);
  float16 n0 = n[0], n1 = n[1], n2 = n[2], n3 = n[3];
  for (uint reached = run->reached[sub_brick]; reached;) {
    const uint i = clz(reached);
    reached ^= FIRST_OF_RUN >> i;
    global const Kernel* k = kernels + list[i];
    const float* m = (const float*)run->from_kernel[i] + sub_brick;
    const float16 pz = fma((float16)(k->zz), z, (float16)(m[2 * SUB_BRICKS]));
    const float16 py = fma((float16)(k->yy), y, fma((float16)(k->yz), z, (float16)(m[SUB_BRICKS])));
    const float16 w_yz = fma(-pz, pz, fma(-py, py, (float16)(k->top)));
    float16 px = fma((float16)(k->xy), y, fma((float16)(k->xz), z, (float16)(m[0] - 1.5f * k->xx)));
#define ADD_SLAB(n)                                              \
  {                                                              \
    const float16 w = fmax(fma(-px, px, w_yz), (float16)(0.0f)); \
    n = ADD_POWER(n, w);                                         \
  }
    ADD_SLAB(n0)
    px += k->xx;
    ADD_SLAB(n1)
    px += k->xx;
    ADD_SLAB(n2)
    px += k->xx;
    ADD_SLAB(n3)
#undef ADD_SLAB
  }
  n[0] = n0;
  n[1] = n1;
  n[2] = n2;
  n[3] = n3;
}

static void store_slab(float16 n, global float* row) {
  vstore4(n.s0123, 0, row);
  vstore4(n.s4567, 0, row + BRICK_EDGE);
  vstore4(n.s89ab, 0, row + 2 * BRICK_EDGE);
  vstore4(n.scdef, 0, row + 3 * BRICK_EDGE);
}

// kernels: the kernel set. origins: one per brick. first: where each brick's list starts in `list`,
// then the end of the last. samples: BRICK_SAMPLES per brick. pairs: the kernel-sample pairs that
// each brick evaluated.
kernel void density_bricks(global const Kernel* restrict kernels,
                           global const int4* restrict origins, global const uint* restrict first,
                           global const uint* restrict list, global float* restrict samples,
                           global uint* restrict pairs) {
  const size_t brick = get_global_id(0);
  const int4 origin = origins[brick];
  float16 n[SUB_BRICKS][4];
  for (int s = 0; s < SUB_BRICKS; ++s) {
    n[s][0] = n[s][1] = n[s][2] = n[s][3] = (float16)(0.0f);
  }
  uint evaluated = 0;
  Run run;
  const uint end = first[brick + 1];
  for (uint i = first[brick]; i < end; i += RUN) {
    test_run(kernels, list + i, (int)min((uint)RUN, end - i), origin, &run);
    for (int s = 0; s < SUB_BRICKS; ++s) {
      sum_run(kernels, list + i, &run, s, n[s]);
      evaluated += popcount(run.reached[s]) * SUB_BRICK_SAMPLES;
    }
  }
  global float* out = samples + brick * BRICK_SAMPLES;
  for (int s = 0; s < SUB_BRICKS; ++s) {
    global float* corner = out + (s >> 2) * 256 + (s >> 1 & 1) * 32 + (s & 1) * 4;
    for (int x = 0; x < 4; ++x) store_slab(n[s][x], corner + x * 64);
  }
  pairs[brick] = evaluated;
}
