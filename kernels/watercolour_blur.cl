// SPDX-License-Identifier: Apache-2.0
// A blur along the columns whose result is turned, columns into rows: twice is a blur both ways and
// the picture upright again, and every load is of whole vectors.
//
// A work-item takes a square of LANES x LANES.
// Global size: pitch / LANES, pitch_turned / LANES.
#include "watercolour.clh"

// Rows that are summed side by side, so that sums need not wait for each other.
#if LANES == 16
#define ROWS 4
#else
#define ROWS 1
#endif

// weights: of the row itself and of its neighbours up to `reach`; rows: of the picture, beyond
// which its first and last row go on; window: LANES + 2 * reach of real.
kernel void blur(image in, int pitch, int rows, constant float* weights, int reach,
                 local real* window, global float* out, int pitch_turned) {
  const int x = get_global_id(0), y = get_global_id(1) * LANES;
  for (int k = 0; k < LANES + 2 * reach; ++k) {
    window[k] = in[clamp(y + k - reach, 0, rows - 1) * (pitch / LANES) + x];
  }
  float square[LANES * LANES] __attribute__((aligned(64)));
  for (int k = 0; k < LANES; k += ROWS) {
    local const real* middle = window + k + reach;
    real sum[ROWS];
#pragma unroll
    for (int r = 0; r < ROWS; ++r) sum[r] = weights[0] * middle[r];
    for (int j = 1; j <= reach; ++j) {
      const real weight = weights[j];
#pragma unroll
      for (int r = 0; r < ROWS; ++r) sum[r] = fma(weight, middle[r - j] + middle[r + j], sum[r]);
    }
#pragma unroll
    for (int r = 0; r < ROWS; ++r) ((real*)square)[k + r] = sum[r];
  }
  for (int lane = 0; lane < LANES; ++lane) {
    for (int k = 0; k < LANES; ++k) {
      out[(x * LANES + lane) * pitch_turned + y + k] = square[k * LANES + lane];
    }
  }
}
