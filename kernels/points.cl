// SPDX-License-Identifier: Apache-2.0
// Computes N and its gradient at scattered points, and moves mesh vertices onto the surface N = T.
//
// Points come in chunks of CHUNK_POINTS that share a list of kernels. On a CPU a work-item takes a
// chunk, its lanes the points (LANES = CHUNK_POINTS); on a GPU a work-item takes one point
// (LANES = 1). Global size: CHUNK_POINTS / LANES times the number of chunks, or more.
#include "density.clh"

#ifndef CHUNK_POINTS
#define CHUNK_POINTS 8  // or 16, the lanes of the widest vectors
#endif
#ifndef LANES
#define LANES CHUNK_POINTS
#endif
#include "lanes.clh"

#if LANES == 8
#define LOAD(p) vload8(get_global_id(0), p)
#define STORE(v, p) vstore8(v, get_global_id(0), p)
#elif LANES == 16
#define LOAD(p) vload16(get_global_id(0), p)
#define STORE(v, p) vstore16(v, get_global_id(0), p)
#else
#define LOAD(p) ((p)[get_global_id(0)])
#define STORE(v, p) ((p)[get_global_id(0)] = (v))
#endif
#define CHUNK (get_global_id(0) * LANES / CHUNK_POINTS)

// The kernels that may reach a chunk's points, and its origin: `PointChunk` of the host.
typedef struct {
  int origin[3];    // points are offsets from there, voxels
  uint first, end;  // in the list
} Chunk;

static Real3 scaled(Real3 v, real s) { return (Real3){v.x * s, v.y * s, v.z * s}; }
static real square(Real3 v) { return fma(v.x, v.x, fma(v.y, v.y, v.z * v.z)); }
static Real3 choose3(Real3 no, Real3 yes, truth c) {
  return (Real3){select(no.x, yes.x, c), select(no.y, yes.y, c), select(no.z, yes.z, c)};
}

typedef struct {
  real density;
  Real3 gradient;
} Sample;

static Sample density_at(global const Kernel* kernels, global const uint* list,
                         global const Chunk* chunk, Real3 p) {
  const int4 origin = {chunk->origin[0], chunk->origin[1], chunk->origin[2], 0};
  Sample s = {REAL(0.0f), {REAL(0.0f), REAL(0.0f), REAL(0.0f)}};
  for (uint i = chunk->first; i < chunk->end; ++i) {
    global const Kernel* k = kernels + list[i];
    // The fourth components are unused.
    const float4 centre = convert_float4(vload4(0, k->cell) - origin) + vload4(0, k->offset);
    const real dx = p.x - centre.x, dy = p.y - centre.y, dz = p.z - centre.z;
    const real u = fma(REAL(k->xx), dx, fma(REAL(k->xy), dy, k->xz * dz));
    const real v = fma(REAL(k->yy), dy, k->yz * dz);
    const real n = k->zz * dz;
    const real w = fmax(fma(-u, u, fma(-n, n, fma(-v, v, REAL(k->top)))), REAL(0.0f));
    s.density = ADD_POWER(s.density, w);
    // grad D = -2 k w^(k-1) U^T (u, v, n), its constant factor last; w = 0 leaves nothing.
    const real slope = SLOPE(w);
    s.gradient.x = fma(slope, k->xx * u, s.gradient.x);
    s.gradient.y = fma(slope, fma(REAL(k->xy), u, k->yy * v), s.gradient.y);
    s.gradient.z = fma(slope, fma(REAL(k->xz), u, fma(REAL(k->yz), v, k->zz * n)), s.gradient.z);
  }
  s.gradient = scaled(s.gradient, REAL(-2.0f * FALLOFF));
  return s;
}

kernel void density_points(global const Kernel* restrict kernels,
                           global const Chunk* restrict chunks, uint count,
                           global const uint* restrict list, global const float* restrict xs,
                           global const float* restrict ys, global const float* restrict zs,
                           global float* restrict density) {
  if (CHUNK >= count) return;
  const Real3 p = {LOAD(xs), LOAD(ys), LOAD(zs)};
  STORE(density_at(kernels, list, chunks + CHUNK, p).density, density);
}

// A point this near to the surface counts as on it, voxels: |N - T| over the steepness.
#define CLOSE_ENOUGH 5e-4f
// The number of times that the way to a corner is halved.
#define HALVINGS 14

typedef struct {
  Real3 at;
  Real3 gradient;
  real miss;  // N - T
} Vertex;

static Vertex choose(Vertex no, Vertex yes, truth c) {
  return (Vertex){choose3(no.at, yes.at, c), choose3(no.gradient, yes.gradient, c),
                  select(no.miss, yes.miss, c)};
}

static truth is_off(Vertex v) { return fabs(v.miss) > CLOSE_ENOUGH * sqrt(square(v.gradient)); }

// A component of a step along the gradient, or zero if it would leave the cell.
static real within(real gradient, real miss, real x, real low) {
  const truth leaves =
      ((x <= low) & (miss * gradient > 0.0f)) | ((x >= low + 1.0f) & (miss * gradient < 0.0f));
  return select(gradient, REAL(0.0f), leaves);
}

// A share of a Newton step along the gradient, at most a voxel long, which slides along the faces
// of the cell [low, low + 1].
static Real3 newton_step(Vertex v, Real3 low, real share) {
  const Real3 way = {within(v.gradient.x, v.miss, v.at.x, low.x),
                     within(v.gradient.y, v.miss, v.at.y, low.y),
                     within(v.gradient.z, v.miss, v.at.z, low.z)};
  const real steepness = square(way);
  const real t = -share * v.miss / fmax(steepness, REAL(1e-20f));
  const Real3 p = along(v.at, way, t / fmax(fabs(t) * sqrt(steepness), REAL(1.0f)));
  return (Real3){clamp(p.x, low.x, low.x + 1.0f), clamp(p.y, low.y, low.y + 1.0f),
                 clamp(p.z, low.z, low.z + 1.0f)};
}

static Real3 corner_of(Real3 low, int i) {
  return (Real3){low.x + (float)(i >> 2 & 1), low.y + (float)(i >> 1 & 1), low.z + (float)(i & 1)};
}

// Moves each point onto N = threshold within the cell that it starts in (steps = 0: leaves it where
// it is) and writes the normal -grad N / |grad N| there, or zero where the gradient vanishes.
//
// It takes at most `steps` Newton steps and halves those that bring N no closer to T. If they end
// where N is flat or in a corner, it finds, by halving, the crossing between the point and the
// nearest corner of the cell on the other side of the surface. A lane that has arrived stays, so a
// point's way does not depend on its chunk. There is a single loop because compile time grows with
// each place that sums.
kernel void snap_points(global const Kernel* restrict kernels, global const Chunk* restrict chunks,
                        uint count, global const uint* restrict list, float threshold, int steps,
                        global float* restrict xs, global float* restrict ys,
                        global float* restrict zs, global float* restrict nxs,
                        global float* restrict nys, global float* restrict nzs) {
  if (CHUNK >= count) return;
  const int corners = steps + 8, end = steps > 0 ? corners + HALVINGS : 0;
  Real3 p = {LOAD(xs), LOAD(ys), LOAD(zs)};
  const Real3 low = {floor(p.x), floor(p.y), floor(p.z)};
  Vertex best = {p, p, REAL(INFINITY)};
  truth off = REAL(0.0f) == REAL(0.0f);
  real share = REAL(1.0f);
  Real3 way = {REAL(0.0f), REAL(0.0f), REAL(0.0f)};  // to the corner
  real nearest = REAL(INFINITY), before = REAL(0.0f), behind = REAL(1.0f), t = REAL(0.5f);
  Vertex start = best;
  for (int i = 0;; ++i) {
    const Sample s = density_at(kernels, list, chunks + CHUNK, p);
    const Vertex v = {p, s.gradient, s.density - threshold};
    if (i <= steps || i > corners) {
      const truth closer = off & (fabs(v.miss) < fabs(best.miss));
      best = choose(best, v, closer);
      share = select(0.5f * share, REAL(1.0f), closer);
      if (i > corners) {
        const truth same = (v.miss >= 0.0f) == (start.miss >= 0.0f);
        before = select(before, t, same);
        behind = select(t, behind, same);
      }
      off = is_off(best);
      if (i >= end || !ANY(off)) break;
    } else {
      const Real3 there = along(p, start.at, REAL(-1.0f));
      const real distance = square(there);
      const truth better = ((v.miss >= 0.0f) != (start.miss >= 0.0f)) & (distance < nearest);
      nearest = select(nearest, distance, better);
      way = choose3(way, there, better);
    }
    if (i < steps) {
      p = newton_step(best, low, share);
    } else if (i < corners) {
      if (i == steps) start = best;
      p = corner_of(low, i - steps);
    } else {
      t = 0.5f * (before + behind);
      p = along(start.at, way, t);
    }
  }
  STORE(best.at.x, xs);
  STORE(best.at.y, ys);
  STORE(best.at.z, zs);
  const real steepness = square(best.gradient);
  const real scale = select(-rsqrt(steepness), REAL(0.0f), steepness < REAL(1e-30f));
  const Real3 normal = scaled(best.gradient, scale);
  STORE(normal.x, nxs);
  STORE(normal.y, nys);
  STORE(normal.z, nzs);
}
