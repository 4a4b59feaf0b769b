// SPDX-License-Identifier: Apache-2.0
// What a device can do at most: fused multiply-adds without memory, and memory without arithmetic.

// Independent chains per work-item: enough to fill the pipeline of any device.
#define CHAINS 12

// Each work-item does 2 * 16 * CHAINS * steps floating-point operations. Global size: any.
kernel void fma_chains(float factor, int steps, global float* restrict out) {
  float16 c[CHAINS];
  for (int i = 0; i < CHAINS; ++i) c[i] = (float16)((float)(get_global_id(0) + (size_t)i));
  const float16 f = (float16)(factor);
  for (int step = 0; step < steps; ++step) {
    c[0] = fma(c[0], f, f);
    c[1] = fma(c[1], f, f);
    c[2] = fma(c[2], f, f);
    c[3] = fma(c[3], f, f);
    c[4] = fma(c[4], f, f);
    c[5] = fma(c[5], f, f);
    c[6] = fma(c[6], f, f);
    c[7] = fma(c[7], f, f);
    c[8] = fma(c[8], f, f);
    c[9] = fma(c[9], f, f);
    c[10] = fma(c[10], f, f);
    c[11] = fma(c[11], f, f);
  }
  float16 sum = c[0];
  for (int i = 1; i < CHAINS; ++i) sum += c[i];
  out[get_global_id(0)] = sum.s0 + sum.s5 + sum.sa + sum.sf;
}

// a = b + factor * c. Global size: the number of float16s in each.
kernel void triad(float factor, global float16* restrict a, global const float16* restrict b,
                  global const float16* restrict c) {
  const size_t i = get_global_id(0);
  a[i] = fma((float16)(factor), c[i], b[i]);
}
