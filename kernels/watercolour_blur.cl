// SPDX-License-Identifier: Apache-2.0
// Blurs along the columns and transposes the result: doing this twice blurs both ways and restores
// the picture's orientation.
//
// weights: that of the pixel, then of its neighbours up to `reach`. rows: the picture's; beyond
// them its first and last row repeat. Global size: pitch / LANES, pitch_turned / LANES. On CPUs a
// work-item takes a square, so that it loads whole vectors, and the local size is 1.
#include "watercolour.clh"

#if LANES == 16

#define SIDE_BY_SIDE 4  // independent sums, which need not wait for each other

// window: LANES + 2 * reach of real.
kernel void blur(image in, int pitch, int rows, constant float* weights, int reach,
                 local real* window, global float* out, int pitch_turned) {
  const int x = get_global_id(0), y = get_global_id(1) * LANES;
  for (int k = 0; k < LANES + 2 * reach; ++k) {
    window[k] = in[clamp(y + k - reach, 0, rows - 1) * (pitch / LANES) + x];
  }
  float square[LANES * LANES] __attribute__((aligned(64)));
  for (int k = 0; k < LANES; k += SIDE_BY_SIDE) {
    local const real* middle = window + k + reach;
    real sum[SIDE_BY_SIDE];
#pragma unroll
    for (int r = 0; r < SIDE_BY_SIDE; ++r) sum[r] = weights[0] * middle[r];
    for (int j = 1; j <= reach; ++j) {
      const real weight = weights[j];
#pragma unroll
      for (int r = 0; r < SIDE_BY_SIDE; ++r) {
        sum[r] = fma(weight, middle[r - j] + middle[r + j], sum[r]);
      }
    }
#pragma unroll
    for (int r = 0; r < SIDE_BY_SIDE; ++r) ((real*)square)[k + r] = sum[r];
  }
  for (int lane = 0; lane < LANES; ++lane) {
    for (int k = 0; k < LANES; ++k) {
      out[(x * LANES + lane) * pitch_turned + y + k] = square[k * LANES + lane];
    }
  }
}

#else

// window: not used.
kernel void blur(image in, int pitch, int rows, constant float* weights, int reach,
                 local real* window, global float* out, int pitch_turned) {
  (void)window;
  const int x = get_global_id(0), y = get_global_id(1);
  real sum = weights[0] * in[min(y, rows - 1) * pitch + x];
  for (int j = 1; j <= reach; ++j) {
    const real above = in[clamp(y - j, 0, rows - 1) * pitch + x];
    sum = fma(weights[j], above + in[min(y + j, rows - 1) * pitch + x], sum);
  }
  out[x * pitch_turned + y] = sum;
}

#endif
