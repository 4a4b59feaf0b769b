// SPDX-License-Identifier: Apache-2.0
// A blur along the columns whose result is turned, columns into rows: twice is a blur both ways and
// the picture upright again, and every load is of whole vectors.
//
// A work-item takes a square of LANES x LANES.
// Global size: pitch / LANES, pitch_turned / LANES.
#include "watercolour.clh"

// weights: of the row itself and of its neighbours up to `reach`; rows: of the picture, beyond
// which its first and last row go on.
kernel void blur(image in, int pitch, int rows, constant float* weights, int reach, canvas out,
                 int pitch_turned) {
  const int x = get_global_id(0) * LANES, y = get_global_id(1) * LANES;
  image column = in + x;
  float square[LANES * LANES];
  for (int k = 0; k < LANES; ++k) {
    const int row = min(y + k, rows - 1);
    real sum = weights[0] * LOAD_AT(row * pitch, column);
    for (int j = 1; j <= reach; ++j) {
      const real above = LOAD_AT(max(row - j, 0) * pitch, column);
      const real below = LOAD_AT(min(row + j, rows - 1) * pitch, column);
      sum = fma(REAL(weights[j]), above + below, sum);
    }
    STORE_AT(sum, k * LANES, square);
  }
  for (int lane = 0; lane < LANES; ++lane) {
    for (int k = 0; k < LANES; ++k) {
      out[(x + lane) * pitch_turned + y + k] = square[k * LANES + lane];
    }
  }
}
