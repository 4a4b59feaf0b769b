// SPDX-License-Identifier: Apache-2.0
// Noise that stays with the paper, and noise that stays with the tree.
//
// Gradient noise. Source: K. Perlin, "Improving Noise", 2002; the gradients come from a hash.
// Global size: the values of a plane / LANES.
#include "watercolour.clh"

static bits mixed(bits h) {
  h = (h ^ (h >> 16)) * 0x21f0aaadu;
  h = (h ^ (h >> 15)) * 0xd35a2d97u;
  return h ^ (h >> 15);
}

// Ten bits of a hash as -1..1.
static real component(bits h, uint shift) {
  return fma(TO_REAL((h >> shift) & 1023u), REAL(2.0f / 1023.0f), REAL(-1.0f));
}

static real fade(real t) {
  return t * t * t * fma(t, fma(t, REAL(6.0f), REAL(-15.0f)), REAL(10.0f));
}

static real corner2(whole x, whole y, uint seed, real dx, real dy) {
  const bits h = mixed(AS_BITS(x) * 0x9e3779b1u ^ mixed(AS_BITS(y) * 0x85ebca77u + seed));
  return fma(component(h, 0), dx, component(h, 10) * dy);
}

// Noise of about -1..1 that repeats after `period` cells either way.
static real noise2(real x, real y, int period, uint seed) {
  const real fx = floor(x), fy = floor(y);
  const whole x0 = TO_WHOLE(fx) % period, y0 = TO_WHOLE(fy) % period;
  const whole x1 = (x0 + 1) % period, y1 = (y0 + 1) % period;
  const real dx = x - fx, dy = y - fy, u = fade(dx);
  const real top = blend(corner2(x0, y0, seed, dx, dy), corner2(x1, y0, seed, dx - 1.0f, dy), u);
  const real bottom =
      blend(corner2(x0, y1, seed, dx, dy - 1.0f), corner2(x1, y1, seed, dx - 1.0f, dy - 1.0f), u);
  return 1.5f * blend(top, bottom, fade(dy));
}

static real corner3(bits x, bits yz, real dx, real dy, real dz) {
  const bits h = mixed(x * 0x9e3779b1u ^ yz);
  return fma(component(h, 0), dx, fma(component(h, 10), dy, component(h, 20) * dz));
}

// Noise of about -1..1.
static real noise3(real x, real y, real z, uint seed) {
  const real fx = floor(x), fy = floor(y), fz = floor(z);
  const bits x0 = AS_BITS(TO_WHOLE(fx)), y0 = AS_BITS(TO_WHOLE(fy)), z0 = AS_BITS(TO_WHOLE(fz));
  const real dx = x - fx, dy = y - fy, dz = z - fz;
  const real u = fade(dx), v = fade(dy), w = fade(dz);
  real side[2];
  for (int k = 0; k < 2; ++k) {
    const bits hz = (z0 + (uint)k) * 0xc2b2ae3du + seed;
    const real ez = dz - (float)k;
    real edge[2];
    for (int j = 0; j < 2; ++j) {
      const bits yz = mixed((y0 + (uint)j) * 0x85ebca77u ^ hz);
      const real ey = dy - (float)j;
      edge[j] = blend(corner3(x0, yz, dx, ey, ez), corner3(x0 + 1u, yz, dx - 1.0f, ey, ez), u);
    }
    side[k] = blend(edge[0], edge[1], v);
  }
  return 1.3f * blend(side[0], side[1], w);
}

// Noise with `cells` cells per period; u and v are fractions of the period.
static real cells2(real u, real v, int cells, uint seed) {
  return noise2(u * (float)cells, v * (float)cells, cells, seed);
}

// The tooth of the paper: felt marks of two sizes.
static real tooth(real u, real v, int cells, uint seed) {
  return fma(REAL(0.62f), cells2(u, v, cells, seed), 0.38f * cells2(u, v, 2 * cells, seed + 1u));
}

// The paper: `height` of its surface, about 0..1; `speckle`, where dispersed pigment lies, and
// `sway`, how a brush's edge wanders over the grain, both about -1..1; `relief`, how much light it
// sends back under a lamp at the upper left, about 1. It repeats after `period` pixels either way.
// cells: cells of the grain per period.
kernel void paper(int pitch, float period, int cells, uint seed, canvas height, canvas speckle,
                  canvas sway, canvas relief) {
  const size_t i = get_global_id(0) * LANES;
  const real u = (REAL((float)(i % pitch) + 0.5f) + RAMP) / period;
  const real v = REAL(((float)(i / pitch) + 0.5f) / period);
  const real fine = cells2(u, v, 3 * cells, seed + 2u);
  const real here = tooth(u, v, cells, seed);
  STORE(saturate(fma(REAL(0.5f), here + 0.3f * fine, REAL(0.5f))), height);
  STORE(fma(REAL(0.7f), fine, 0.5f * cells2(u, v, cells * 3 / 2, seed + 3u)), speckle);
  STORE(fma(REAL(0.7f), cells2(u, v, max(cells / 5, 1), seed + 5u),
            0.5f * cells2(u, v, max(cells / 2, 1), seed + 4u)),
        sway);
  const float half_cell = 0.5f / (float)cells;
  const real right = tooth(u + half_cell, v, cells, seed);
  const real below = tooth(u, v + half_cell, cells, seed);
  STORE(1.0f + (here - right) + (here - below) + 0.5f * fine, relief);
}

// A patch of ground at (foot_x, foot_y) with half-axes of (reach_x, reach_y) pixels, streaked along
// the ground: 1 in its middle, falling through 0 outwards.
kernel void ground(int pitch, float size, float foot_x, float foot_y, float reach_x, float reach_y,
                   uint seed, canvas out) {
  const size_t i = get_global_id(0) * LANES;
  const real x = REAL((float)(i % pitch) + 0.5f) + RAMP;
  const float y = (float)(i / pitch) + 0.5f;
  const real dx = (x - foot_x) / reach_x;
  const real dy = REAL((y - foot_y) / reach_y);
  const real u = x / size + 16.0f, v = REAL(y / size + 16.0f);
  const real streaks = fma(REAL(0.6f), noise2(u * 5.0f, v * 35.0f, 1 << 20, seed),
                           0.4f * noise2(u * 14.0f, v * 90.0f, 1 << 20, seed + 1u));
  STORE(1.0f - sqrt(fma(dx, dx, dy * dy)) + 0.8f * streaks, out);
}

// Noise at points (x, y, z) of the tree, where `near` is not 0: `turbulence` of the pigment,
// `warmth` at the crown's scale, `breaking` of edges into leaves, `wetness` in patches; all about
// -1..1. scale, leaf_scale: cells of the turbulence and of leaves in a unit of the scene.
kernel void flow(image near, image x, image y, image z, float scale, float leaf_scale, uint seed,
                 canvas turbulence, canvas warmth, canvas breaking, canvas wetness) {
  if (!ANY(LOAD(near) > REAL(0.0f))) {
    STORE(REAL(0.0f), turbulence);
    STORE(REAL(0.0f), warmth);
    STORE(REAL(0.0f), breaking);
    STORE(REAL(0.0f), wetness);
    return;
  }
  const real px = LOAD(x), py = LOAD(y), pz = LOAD(z);
  real sum[4] = {REAL(0.0f), REAL(0.0f), REAL(0.0f), REAL(0.0f)};
  const float scales[8] = {scale,        2.1f * scale, 4.3f * scale,      0.45f * scale,
                           1.1f * scale, leaf_scale,   2.2f * leaf_scale, 0.8f * scale};
  const float weights[8] = {0.6f, 0.4f, 0.25f, 0.8f, 0.45f, 0.7f, 0.5f, 1.0f};
  const int fields[8] = {0, 0, 0, 1, 1, 2, 2, 3};
  for (int k = 0; k < 8; ++k) {
    const float s = scales[k];
    sum[fields[k]] =
        fma(REAL(weights[k]), noise3(px * s, py * s, pz * s, seed + (uint)k), sum[fields[k]]);
  }
  STORE(sum[0], turbulence);
  STORE(sum[1], warmth);
  STORE(sum[2], breaking);
  STORE(sum[3], wetness);
}
