// SPDX-License-Identifier: Apache-2.0
// Casts rays at the surface N = T, without polygons.
//
// Space is root blocks of 32 samples; a root is outside, inside or 64 bricks of 8 samples, each
// outside, inside or evaluated. In an evaluated brick N comes from the kernels near it or, if
// SAMPLED is defined, trilinearly from its samples. Along a ray, a kernel's xi is a parabola
// (Kanamori et al., "GPU-based Fast Ray Casting for a Large Number of Metaballs", 2008, call what
// is near a ray its active list); N is summed at STEPS points of a ray's way through a brick, and
// the piece where it passes T is cut again, until it is short.
//
// On a CPU a work-item takes LANES = 16 rays, neighbours that meet the same bricks; on a GPU one
// (LANES = 1). Positions are voxels from the lattice's anchor, directions unit vectors.
// Global size: the number of rays over LANES, or more.
#include "way.clh"

// A step over the edge of a block, voxels; larger if t is so large that rounding would lose it.
#define NUDGE(t) fmax(4e-7f * (t), 1e-3f)
// The allowance for rounding when a kernel is tested against a beam, voxels.
#define BEAM_SLACK 1e-2f
// How far past a crossing that is not drawn a ray goes on.
#define PAST_HIDDEN 1e-2f

static real kept_from_zero(real d) { return select(d, REAL(1e-12f), fabs(d) < 1e-12f); }

// The first and the last point near the surface on the lanes' ways through a brick; if there is
// none, the first is behind the last.
static int2 near_stretch(const Grid* grid, int brick, Real3 p, Real3 d, real step, truth lanes) {
  const Truths here = {.v = lanes};
  int2 stretch = {STEPS, -1};
  for (int i = 0; i < STEPS; ++i) {
    const Real3 q = along(p, d, step * (float)i);
    const Reals x = {.v = clamp(q.x, 0.0f, 7.0f)}, y = {.v = clamp(q.y, 0.0f, 7.0f)},
                z = {.v = clamp(q.z, 0.0f, 7.0f)};
    for (int lane = 0; lane < LANES; ++lane) {
      if (!here.lane[lane]) continue;
      const int cell = in_brick((int)x.lane[lane], (int)y.lane[lane], (int)z.lane[lane]);
      if (!has_bit(grid->near, brick, cell)) continue;
      stretch.x = min(stretch.x, i);
      stretch.y = i;
      break;
    }
  }
  return stretch;
}

static int first_of(truth lanes) {
  const Truths t = {.v = lanes};
  int lane = 0;
  while (lane < LANES - 1 && !t.lane[lane]) ++lane;
  return lane;
}

// The beam around the lanes' ways, with positions from the anchor.
static Beam beam_of(const Block* block, Real3 p, Real3 d, real step, truth lanes) {
  const Reals px = {.v = p.x}, py = {.v = p.y}, pz = {.v = p.z};
  const Reals dx = {.v = d.x}, dy = {.v = d.y}, dz = {.v = d.z};
  const int lane = first_of(lanes);
  Beam b = {px.lane[lane], py.lane[lane], pz.lane[lane], dx.lane[lane],
            dy.lane[lane], dz.lane[lane], 0.0f,          0.0f};
  const Reals length = {.v = select(REAL(0.0f), step * (float)PIECES, lanes)};
  for (int i = 0; i < LANES; ++i) b.length = fmax(b.length, length.lane[i]);
  // Two lines are farthest apart at one end of the way.
  const Real3 q = along(p, d, REAL(b.length));
  const real x0 = p.x - b.x, y0 = p.y - b.y, z0 = p.z - b.z;
  const real x1 = q.x - fma(b.length, b.dx, b.x), y1 = q.y - fma(b.length, b.dy, b.y),
             z1 = q.z - fma(b.length, b.dz, b.z);
  const real apart = fmax(fma(x0, x0, fma(y0, y0, z0 * z0)), fma(x1, x1, fma(y1, y1, z1 * z1)));
  const Reals square = {.v = select(REAL(0.0f), apart, lanes)};
  for (int i = 0; i < LANES; ++i) b.width = fmax(b.width, square.lane[i]);
  const float x = (float)block->low[0], y = (float)block->low[1], z = (float)block->low[2];
  b.x += x, b.y += y, b.z += z;
  b.width = sqrt(b.width) + BEAM_SLACK * fmax(1.0f, 1e-4f * (fabs(x) + fabs(y) + fabs(z)));
  return b;
}

// rays: an origin and a unit direction each. hits: the distance, infinite where there is none, and
// the gradient of N, up to a positive factor.
kernel void rays_closest(GRID_ARGUMENTS, global const Kernel* restrict kernels,
                         global const float4* restrict balls, global const uint* restrict first,
                         global const uint* restrict list, float threshold, uint count,
                         global const float* restrict rays, global float4* restrict hits) {
  const uint first_ray = get_global_id(0) * LANES;
  if (first_ray >= count) return;
  const Grid grid = GRID;

  Reals component[6];
  for (int lane = 0; lane < LANES; ++lane) {
    global const float* ray = rays + 6 * (size_t)min(first_ray + lane, count - 1);
    for (int i = 0; i < 6; ++i) component[i].lane[lane] = ray[i];
  }
  Real3 o = {component[0].v, component[1].v, component[2].v};
  const Real3 d = {kept_from_zero(component[3].v), kept_from_zero(component[4].v),
                   kept_from_zero(component[5].v)};
  const Real3 inverse = {1.0f / d.x, 1.0f / d.y, 1.0f / d.z};

  // Rays begin where they enter the grid from here on, as floats are precise there.
  const Real3 to_low = {((float)(low.x * ROOT_EDGE) - o.x) * inverse.x,
                        ((float)(low.y * ROOT_EDGE) - o.y) * inverse.y,
                        ((float)(low.z * ROOT_EDGE) - o.z) * inverse.z};
  const Real3 to_high = {((float)((low.x + size.x) * ROOT_EDGE) - o.x) * inverse.x,
                         ((float)((low.y + size.y) * ROOT_EDGE) - o.y) * inverse.y,
                         ((float)((low.z + size.z) * ROOT_EDGE) - o.z) * inverse.z};
  const real entry = fmax(fmax(fmin(to_low.x, to_high.x), fmin(to_low.y, to_high.y)),
                          fmax(fmin(to_low.z, to_high.z), REAL(0.0f)));
  const real end =
      fmin(fmin(fmax(to_low.x, to_high.x), fmax(to_low.y, to_high.y)), fmax(to_low.z, to_high.z)) -
      entry;
  o = along(o, d, entry);

  truth active = end > 0.0f;
  truth inside = FALSE, known = entry > 0.0f;  // the side of the surface, and whether it is known
  Source source;
  source.kernels = kernels;
  source.balls = balls;
  source.grid = &grid;
  source.threshold = threshold;
  real t = REAL(0.0f);
  Reals distance = {.v = REAL(INFINITY)};
  Reals gradient[3] = {{.v = REAL(0.0f)}, {.v = REAL(0.0f)}, {.v = REAL(0.0f)}};

  while (ANY(active)) {
    const real ahead = t + NUDGE(t);
    const Real3 p = along(o, d, ahead);
    const Reals px = {.v = p.x}, py = {.v = p.y}, pz = {.v = p.z};
    const int leader = first_of(active);
    const Block block = block_at(&grid, (int)floor(px.lane[leader]), (int)floor(py.lane[leader]),
                                 (int)floor(pz.lane[leader]));
    const float lx = (float)block.low[0], ly = (float)block.low[1], lz = (float)block.low[2];
    const float edge = (float)block.edge;
    const truth here = active & (p.x >= lx) & (p.x < lx + edge) & (p.y >= ly) & (p.y < ly + edge) &
                       (p.z >= lz) & (p.z < lz + edge);
    const Real3 far = {select(REAL(lx), REAL(lx + edge), d.x > 0.0f),
                       select(REAL(ly), REAL(ly + edge), d.y > 0.0f),
                       select(REAL(lz), REAL(lz + edge), d.z > 0.0f)};
    const real leaves =
        fmin(fmin((far.x - o.x) * inverse.x, (far.y - o.y) * inverse.y), (far.z - o.z) * inverse.z);
    const real exit = fmin(fmax(leaves, ahead), end);

    if (block.content < 0) {
      inside = select(inside, block.content == INSIDE ? TRUE : FALSE, here);
      known |= here;
      t = select(t, exit, here);
      active &= !(here & (t >= end));
      continue;
    }

    const Real3 from = along((Real3){o.x - lx, o.y - ly, o.z - lz}, d, t);
    const real step = fmax(exit - t, REAL(0.0f)) / (float)PIECES;
    const int2 stretch = near_stretch(&grid, block.content, from, d, step, here);
    if (stretch.x > stretch.y) {
      known &= !here;
      t = select(t, exit, here);
      active &= !(here & (t >= end));
      continue;
    }
    // Covers the first to the last point near the surface, and one more on each side.
    const int begin = max(stretch.x - 1, 0), finish = min(stretch.y + 1, PIECES);
    if (begin > 0) known &= !here;
    const real skipped = step * (float)begin;
    const real finer = step * ((float)(finish - begin) / (float)PIECES);
    const Real3 p0 = along(from, d, skipped);
    source.low[0] = block.low[0], source.low[1] = block.low[1], source.low[2] = block.low[2];
#ifndef SAMPLED
    source.list = list + first[block.content];
    source.count = first[block.content + 1] - first[block.content];
#else
    (void)first;
#endif
    real n[STEPS];
    sum_way(&source, p0, d, finer, beam_of(&block, p0, d, finer, here), n);
    inside = select(inside, n[0] >= threshold, here & !known);
    const Crossing crossing = first_crossing(n, threshold, inside);
    const truth crossed = crossing.found & here;
    const truth through = here & !crossed;
    inside = select(inside, n[PIECES] >= threshold, through);
    known = select(known, finish == PIECES ? TRUE : FALSE, through);
    if (ANY(crossed)) {
      const Reals way = {.v = pin_down(&source, p0, d, finer, threshold, crossing)};
      const Real3 at = along(p0, d, way.v);
      const Reals x = {.v = at.x}, y = {.v = at.y}, z = {.v = at.z};
      Truths drawn_here = {.v = crossed};
      for (int lane = 0; lane < LANES; ++lane) {
        if (!drawn_here.lane[lane]) continue;
        const int cell = in_brick(clamp((int)x.lane[lane], 0, 7), clamp((int)y.lane[lane], 0, 7),
                                  clamp((int)z.lane[lane], 0, 7));
        if (!has_bit(grid.drawn, block.content, cell)) drawn_here.lane[lane] = 0;
      }
      const truth meets = drawn_here.v, passes = crossed & !drawn_here.v;
      if (ANY(meets)) {
        const Real3 g = gradient_at(&source, at);
        distance.v = select(distance.v, entry + t + skipped + way.v, meets);
        gradient[0].v = select(gradient[0].v, g.x, meets);
        gradient[1].v = select(gradient[1].v, g.y, meets);
        gradient[2].v = select(gradient[2].v, g.z, meets);
        active &= !meets;
      }
      inside = select(inside, crossing.enters, passes);
      known |= passes;
      t = select(t, t + skipped + way.v + PAST_HIDDEN, passes);
    }
    t = select(t, exit, through);
    active &= !(here & (t >= end));
  }

  for (int lane = 0; lane < LANES; ++lane) {
    if (first_ray + lane >= count) return;
    hits[first_ray + lane] = (float4)(distance.lane[lane], gradient[0].lane[lane],
                                      gradient[1].lane[lane], gradient[2].lane[lane]);
  }
}

// ---- Light ----

// The share of light that is blocked along a ray of length `reach`, 0 to 1: the highest
// saturate((N - T) / soft) at points a voxel apart, with N from the samples. A small `soft` tells
// whether the ray meets a place inside, which is shadow; a `soft` of T gives ambient occlusion.
// There is a work-item per ray.
kernel void rays_blocked(GRID_ARGUMENTS, float threshold, float soft, float reach, uint count,
                         global const float* restrict rays, global float* restrict blocked) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const Grid grid = GRID;
  global const float* ray = rays + 6 * (size_t)i;
  float o[3], d[3], inverse[3];
  float t = 0.0f, end = reach;
  const int first_root[3] = {low.x, low.y, low.z}, roots_along[3] = {size.x, size.y, size.z};
  for (int a = 0; a < 3; ++a) {
    o[a] = ray[a];
    d[a] = fabs(ray[a + 3]) < 1e-12f ? 1e-12f : ray[a + 3];
    inverse[a] = 1.0f / d[a];
    const float to_low = ((float)(first_root[a] * ROOT_EDGE) - o[a]) * inverse[a];
    const float to_high =
        ((float)((first_root[a] + roots_along[a]) * ROOT_EDGE) - o[a]) * inverse[a];
    t = fmax(t, fmin(to_low, to_high));
    end = fmin(end, fmax(to_low, to_high));
  }
  // The ray begins where it enters the grid from here on, as floats are precise there.
  for (int a = 0; a < 3; ++a) o[a] = fma(t, d[a], o[a]);
  end -= t;
  t = 0.0f;
  float most = 0.0f;
  int counts = 0;  // whether the ray is inside a drawn part, whose surface it passed
  while (t < end && most < 1.0f) {
    const float x = fma(t, d[0], o[0]), y = fma(t, d[1], o[1]), z = fma(t, d[2], o[2]);
    const int cx = (int)floor(x), cy = (int)floor(y), cz = (int)floor(z);
    const Block block = block_at(&grid, cx, cy, cz);
    if (block.content >= 0) {
      const float above = sampled_density(&grid, threshold, x, y, z) - threshold;
      counts =
          (above >= 0.0f) & (counts | has_bit(grid.drawn, block.content, in_brick(cx, cy, cz)));
      if (counts) most = fmax(most, fmin(above / soft, 1.0f));
      t += 1.0f;
    } else {
      if ((block.content == INSIDE) & counts) most = 1.0f;
      float leaves = INFINITY;
      for (int a = 0; a < 3; ++a) {
        const float far = (float)(block.low[a] + (d[a] > 0.0f ? block.edge : 0));
        leaves = fmin(leaves, (far - o[a]) * inverse[a]);
      }
      t = fmax(leaves, t);
      t += NUDGE(t);
    }
  }
  blocked[i] = most;
}
