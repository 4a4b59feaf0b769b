// SPDX-License-Identifier: Apache-2.0
// N and its gradient at scattered points, and the way of a mesh vertex onto the surface N = T.
//
// Points come in chunks of 16 that share a brick and its list of kernels. On a CPU a work-item
// takes a chunk, its lanes the points (LANES 16); on a GPU a work-item takes one point (LANES 1).
// Global size: 16 / LANES times the number of chunks; local size 16 / LANES.
#include "density.clh"

#ifndef LANES
#define LANES 16
#endif

#if LANES == 16
typedef float16 real;
typedef int16 truth;
#define LOAD(p) vload16(get_global_id(0), p)
#define STORE(v, p) vstore16(v, get_global_id(0), p)
#define ANY(c) any(c)
#else
typedef float real;
typedef int truth;
#define LOAD(p) ((p)[get_global_id(0)])
#define STORE(v, p) ((p)[get_global_id(0)] = (v))
#define ANY(c) (c)
#endif
#define REAL(x) ((real)(x))
#define CHUNK (get_global_id(0) * LANES / 16)

// Which kernels a chunk's points see, and from where.
typedef struct {
  int origin[3];    // of the brick; offsets of points are from here, voxels
  uint first, end;  // in the list
  uint unused[3];
} Chunk;

typedef struct {
  real density, dx, dy, dz;
} Sample;

static Sample density_at(global const Kernel* kernels, global const uint* list,
                         global const Chunk* chunk, real x, real y, real z) {
  Sample s = {REAL(0.0f), REAL(0.0f), REAL(0.0f), REAL(0.0f)};
  for (uint i = chunk->first; i < chunk->end; ++i) {
    global const Kernel* k = kernels + list[i];
    const real px = x - ((float)(k->cell[0] - chunk->origin[0]) + k->offset[0]);
    const real py = y - ((float)(k->cell[1] - chunk->origin[1]) + k->offset[1]);
    const real pz = z - ((float)(k->cell[2] - chunk->origin[2]) + k->offset[2]);
    const real u = fma(REAL(k->xx), px, fma(REAL(k->xy), py, k->xz * pz));
    const real v = fma(REAL(k->yy), py, k->yz * pz);
    const real n = k->zz * pz;
    const real w = fmax(fma(-u, u, fma(-n, n, fma(-v, v, REAL(1.0f)))), REAL(0.0f));
    s.density = ADD_POWER(s.density, w);
    // grad D = -2 k w^(k-1) U^T (u, v, n); w = 0 leaves nothing.
#if FALLOFF == 1
    const real slope = select(REAL(0.0f), REAL(-2.0f), w > REAL(0.0f));
#elif FALLOFF == 2
    const real slope = -4.0f * w;
#else
    const real slope = -6.0f * w * w;
#endif
    s.dx = fma(slope, k->xx * u, s.dx);
    s.dy = fma(slope, fma(REAL(k->xy), u, k->yy * v), s.dy);
    s.dz = fma(slope, fma(REAL(k->xz), u, fma(REAL(k->yz), v, k->zz * n)), s.dz);
  }
  return s;
}

kernel void density_points(global const Kernel* restrict kernels,
                           global const Chunk* restrict chunks, global const uint* restrict list,
                           global const float* restrict xs, global const float* restrict ys,
                           global const float* restrict zs, global float* restrict density) {
  const Sample s = density_at(kernels, list, chunks + CHUNK, LOAD(xs), LOAD(ys), LOAD(zs));
  STORE(s.density, density);
}

// Squared steepness of N.
static real steepness_of(Sample s) { return fma(s.dx, s.dx, fma(s.dy, s.dy, s.dz * s.dz)); }

// How near to the surface counts as on it, voxels: |N - T| against the steepness.
#define CLOSE_ENOUGH 5e-4f
#define IS_OFF(miss, s) (fabs(miss) > CLOSE_ENOUGH * sqrt(steepness_of(s)))

typedef struct {
  real x, y, z;
  Sample sample;
  real miss;  // N - T
} Vertex;

static Vertex vertex_at(global const Kernel* kernels, global const uint* list,
                        global const Chunk* chunk, float threshold, real x, real y, real z) {
  const Sample s = density_at(kernels, list, chunk, x, y, z);
  const Vertex v = {x, y, z, s, s.density - threshold};
  return v;
}

static Vertex choose(Vertex no, Vertex yes, truth c) {
  const Sample s = {select(no.sample.density, yes.sample.density, c),
                    select(no.sample.dx, yes.sample.dx, c), select(no.sample.dy, yes.sample.dy, c),
                    select(no.sample.dz, yes.sample.dz, c)};
  const Vertex v = {select(no.x, yes.x, c), select(no.y, yes.y, c), select(no.z, yes.z, c), s,
                    select(no.miss, yes.miss, c)};
  return v;
}

// At most `steps` Newton steps along the gradient, cut at the faces of the cell [low, low + 1]; a
// step that brings N no closer to T is halved.
static Vertex newton(global const Kernel* kernels, global const uint* list,
                     global const Chunk* chunk, float threshold, int steps, Vertex best, real low_x,
                     real low_y, real low_z) {
  real share = REAL(1.0f);
  for (int step = 0; step < steps && ANY(IS_OFF(best.miss, best.sample)); ++step) {
    const real steepness = steepness_of(best.sample);
    const real t = -share * best.miss / fmax(steepness, REAL(1e-20f));
    const real along = t / fmax(fabs(t) * sqrt(steepness), REAL(1.0f));  // a voxel at most
    const Vertex next = vertex_at(kernels, list, chunk, threshold,
                                  clamp(fma(along, best.sample.dx, best.x), low_x, low_x + 1.0f),
                                  clamp(fma(along, best.sample.dy, best.y), low_y, low_y + 1.0f),
                                  clamp(fma(along, best.sample.dz, best.z), low_z, low_z + 1.0f));
    const truth closer = fabs(next.miss) < fabs(best.miss);
    best = choose(best, next, closer);
    share = select(0.5f * share, REAL(1.0f), closer);
  }
  return best;
}

// Where Newton's way ends at a face or on a plain: the crossing between the point and the nearest
// corner of the cell on the other side of the surface, by halving. A cell of the mesh has corners
// on both.
static Vertex bisect(global const Kernel* kernels, global const uint* list,
                     global const Chunk* chunk, float threshold, Vertex start, real low_x,
                     real low_y, real low_z) {
  real dx = REAL(0.0f), dy = REAL(0.0f), dz = REAL(0.0f), nearest = REAL(INFINITY);
  const truth above = start.miss >= 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const Vertex v = vertex_at(kernels, list, chunk, threshold, low_x + (float)(corner >> 2 & 1),
                               low_y + (float)(corner >> 1 & 1), low_z + (float)(corner & 1));
    const real ex = v.x - start.x, ey = v.y - start.y, ez = v.z - start.z;
    const real distance = fma(ex, ex, fma(ey, ey, ez * ez));
    const truth better = ((v.miss >= 0.0f) != above) & (distance < nearest);
    nearest = select(nearest, distance, better);
    dx = select(dx, ex, better);
    dy = select(dy, ey, better);
    dz = select(dz, ez, better);
  }
  real low = REAL(0.0f), high = REAL(1.0f);
  for (int step = 0; step < 14; ++step) {
    const real t = 0.5f * (low + high);
    const Vertex v = vertex_at(kernels, list, chunk, threshold, fma(t, dx, start.x),
                               fma(t, dy, start.y), fma(t, dz, start.z));
    const truth before = (v.miss >= 0.0f) == above;
    low = select(low, t, before);
    high = select(t, high, before);
  }
  return vertex_at(kernels, list, chunk, threshold, fma(low, dx, start.x), fma(low, dy, start.y),
                   fma(low, dz, start.z));
}

// Moves each point onto N = threshold within the cell that it starts in (steps = 0: leaves it where
// it is) and writes the normal -grad N / |grad N| there, or zero where the gradient vanishes.
kernel void snap_points(global const Kernel* restrict kernels, global const Chunk* restrict chunks,
                        global const uint* restrict list, float threshold, int steps,
                        global float* restrict xs, global float* restrict ys,
                        global float* restrict zs, global float* restrict nxs,
                        global float* restrict nys, global float* restrict nzs) {
  global const Chunk* chunk = chunks + CHUNK;
  const real x = LOAD(xs), y = LOAD(ys), z = LOAD(zs);
  const real low_x = floor(x), low_y = floor(y), low_z = floor(z);
  Vertex v = vertex_at(kernels, list, chunk, threshold, x, y, z);
  if (steps > 0) {
    v = newton(kernels, list, chunk, threshold, steps, v, low_x, low_y, low_z);
    const truth off = IS_OFF(v.miss, v.sample);
    if (ANY(off)) {
      v = choose(v, bisect(kernels, list, chunk, threshold, v, low_x, low_y, low_z), off);
    }
  }
  STORE(v.x, xs);
  STORE(v.y, ys);
  STORE(v.z, zs);
  const real steepness = steepness_of(v.sample);
  const real scale = select(-rsqrt(steepness), REAL(0.0f), steepness < REAL(1e-30f));
  STORE(v.sample.dx * scale, nxs);
  STORE(v.sample.dy * scale, nys);
  STORE(v.sample.dz * scale, nzs);
}
