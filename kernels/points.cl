// SPDX-License-Identifier: Apache-2.0
// Computes N and its gradient at scattered points, and moves mesh vertices onto the surface N = T.
//
// The points of a block come in groups of up to CHUNKS chunks of CHUNK_POINTS, which share the
// block's list of kernels. First, each kernel of the list is tested against the boxes of all chunks
// and gets a mark in those that it reaches. Then every chunk sums its marked kernels in the order
// of the list.
//
// On a CPU a work-item takes a group, its lanes the points of a chunk (LANES = CHUNK_POINTS).
// Global size: the number of groups. On a GPU a work-group takes a group, a work-item a point
// (LANES = 1). Global size: CHUNKS * CHUNK_POINTS times the number of groups.
#include "density.clh"

#ifndef CHUNK_POINTS
#define CHUNK_POINTS 8  // or 16, the lanes of the widest vectors
#endif
#ifndef LANES
#define LANES CHUNK_POINTS
#endif
#include "lanes.clh"
#include "marks.clh"

#ifndef CHUNKS
#define CHUNKS 8
#endif
#if CHUNKS != 8
#error "a vector holds the boxes of 8 chunks"
#endif

// The points of a group: `PointGroup` of the host.
typedef struct {
  int origin[3];       // points are offsets from there, voxels
  uint first, end;     // the kernels that may reach them, in the list
  uint chunk, chunks;  // the first of its chunks, and their number
  uint entry;          // where its list is in the scratch space of a launch, a multiple of RUN
} Group;

// Loops over the chunks that a work-item takes; its points are at LOAD and STORE.
#if LANES == 1
#define GROUP (get_group_id(0))
#define FOR_EACH_CHUNK(c) \
  for (uint c = (uint)get_local_id(0) / CHUNK_POINTS; c < group->chunks; c += CHUNKS)
#define POINT(c) ((group->chunk + c) * CHUNK_POINTS + get_local_id(0) % CHUNK_POINTS)
#define LOAD(c, p) ((p)[POINT(c)])
#define STORE(v, c, p) ((p)[POINT(c)] = (v))
#else
#define GROUP (get_global_id(0))
#define FOR_EACH_CHUNK(c) for (uint c = 0; c < group->chunks; ++c)
#if LANES == 8
#define LOAD(c, p) vload8(group->chunk + c, p)
#define STORE(v, c, p) vstore8(v, group->chunk + c, p)
#else
#define LOAD(c, p) vload16(group->chunk + c, p)
#define STORE(v, c, p) vstore16(v, group->chunk + c, p)
#endif
#endif

// A GPU's work-item marks one chunk at a time, a CPU's all of them.
#if LANES == 1
typedef float Boxes;
typedef uint Marks;
#define WHERE(c) ((uint)(-(c)))
#else
typedef float8 Boxes;
typedef uint8 Marks;
#define WHERE(c) as_uint8(c)
#endif

// Centres and half the extents of the boxes around the points of chunks.
typedef struct {
  Boxes x, y, z, half_x, half_y, half_z;
} ChunkBoxes;

// A kernel of a group's list, its centre counted from the group's origin.
typedef struct {
  float x, y, z;
  float xx, xy, xz, yy, yz, zz;
  float top;
} NearKernel;

// Copies a kernel by vectors; loops over its members become slow gathers.
static void fetch(global const Kernel* k, int4 origin, global NearKernel* near) {
  // The fourth components are written over.
  vstore4(convert_float4(vload4(0, k->cell) - origin) + vload4(0, k->offset), 0, &near->x);
  vstore4(vload4(0, &k->xx), 0, &near->xx);
  vstore3(vload3(0, &k->yz), 0, &near->yz);
}

static Marks marks_of(global const NearKernel* near, uint count, ChunkBoxes boxes) {
  Marks marks = 0;
  for (uint i = 0; i < count; ++i) {
    global const NearKernel* k = near + i;
    const Boxes dx = boxes.x - k->x, dy = boxes.y - k->y, dz = boxes.z - k->z;
    const float xy = fabs(k->xy), xz = fabs(k->xz), yz = fabs(k->yz);
    const Boxes mx = fabs(fma((Boxes)(k->xx), dx, fma((Boxes)(k->xy), dy, k->xz * dz)));
    const Boxes my = fabs(fma((Boxes)(k->yy), dy, k->yz * dz));
    const Boxes mz = fabs(k->zz * dz);
    const Boxes ex =
        fma((Boxes)(k->xx), boxes.half_x, fma((Boxes)(xy), boxes.half_y, xz * boxes.half_z));
    const Boxes ey = fma((Boxes)(k->yy), boxes.half_y, yz * boxes.half_z);
    const Boxes ez = k->zz * boxes.half_z;
    const Boxes near_x = fmax(mx - ex, (Boxes)(0.0f));
    const Boxes near_y = fmax(my - ey, (Boxes)(0.0f));
    const Boxes near_z = fmax(mz - ez, (Boxes)(0.0f));
    const Boxes least = fma(near_x, near_x, fma(near_y, near_y, near_z * near_z));
    marks |= WHERE(least < XI_SLACK * k->top) & (FIRST_OF_RUN >> i);
  }
  return marks;
}

// A group with the kernels of its list and their marks.
typedef struct {
  global const Group* group;
  global const NearKernel* near;
  global const uint* marks;
} Marked;

// Fetches the kernels of a group's list and marks those that reach its chunks. `all_boxes` has
// CHUNKS numbers for each member of ChunkBoxes.
static Marked mark(global const Kernel* kernels, global const Group* groups,
                   global const uint* list, global const float* all_boxes,
                   global NearKernel* all_near, global uint* all_marks) {
  global const Group* group = groups + GROUP;
  global const float* boxes = all_boxes + GROUP * 6 * CHUNKS;
  global NearKernel* near = all_near + group->entry;
  global uint* marks = all_marks + group->entry / RUN * CHUNKS;
  const uint size = group->end - group->first;
  const uint runs = (size + RUN - 1) / RUN;
  const int4 origin = {group->origin[0], group->origin[1], group->origin[2], 0};
#if LANES == 1
  const uint item = (uint)get_local_id(0), items = (uint)get_local_size(0);
  for (uint i = item; i < size; i += items) {
    fetch(kernels + list[group->first + i], origin, near + i);
  }
  barrier(CLK_GLOBAL_MEM_FENCE);
  for (uint i = item; i < runs * CHUNKS; i += items) {
    const uint begin = i / CHUNKS * RUN;
    global const float* b = boxes + i % CHUNKS;
    const ChunkBoxes box = {b[0],          b[CHUNKS],     b[2 * CHUNKS],
                            b[3 * CHUNKS], b[4 * CHUNKS], b[5 * CHUNKS]};
    marks[i] = marks_of(near + begin, min((uint)RUN, size - begin), box);
  }
  barrier(CLK_GLOBAL_MEM_FENCE);
#else
  for (uint i = 0; i < size; ++i) {
    fetch(kernels + list[group->first + i], origin, near + i);
  }
  const ChunkBoxes all = {vload8(0, boxes), vload8(1, boxes), vload8(2, boxes),
                          vload8(3, boxes), vload8(4, boxes), vload8(5, boxes)};
  for (uint run = 0; run < runs; ++run) {
    const uint begin = run * RUN;
    vstore8(marks_of(near + begin, min((uint)RUN, size - begin), all), run, marks);
  }
#endif
  return (Marked){group, near, marks};
}

static Real3 scaled(Real3 v, real s) { return (Real3){v.x * s, v.y * s, v.z * s}; }
static real square(Real3 v) { return fma(v.x, v.x, fma(v.y, v.y, v.z * v.z)); }
static Real3 choose3(Real3 no, Real3 yes, truth c) {
  return (Real3){select(no.x, yes.x, c), select(no.y, yes.y, c), select(no.z, yes.z, c)};
}

typedef struct {
  real density;
  Real3 gradient;
} Sample;

// Sums at the points of a chunk.
static Sample density_at(Marked of, uint chunk, Real3 p) {
  const uint size = of.group->end - of.group->first;
  global const uint* marks = of.marks + chunk;
  Sample s = {REAL(0.0f), {REAL(0.0f), REAL(0.0f), REAL(0.0f)}};
  for (uint begin = 0; begin < size; begin += RUN, marks += CHUNKS) {
    for (uint marked = *marks; marked;) {
      const uint i = clz(marked);
      marked ^= FIRST_OF_RUN >> i;
      global const NearKernel* k = of.near + begin + i;
      const real dx = p.x - k->x, dy = p.y - k->y, dz = p.z - k->z;
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
  }
  s.gradient = scaled(s.gradient, REAL(-2.0f * FALLOFF));
  return s;
}

// N at the points of each group.
kernel void density_points(global const Kernel* restrict kernels,
                           global const Group* restrict groups, global const uint* restrict list,
                           global const float* restrict boxes, global NearKernel* restrict all_near,
                           global uint* restrict all_marks, global const float* restrict xs,
                           global const float* restrict ys, global const float* restrict zs,
                           global float* restrict density) {
  const Marked marked = mark(kernels, groups, list, boxes, all_near, all_marks);
  global const Group* group = marked.group;
  FOR_EACH_CHUNK(c) {
    const Real3 p = {LOAD(c, xs), LOAD(c, ys), LOAD(c, zs)};
    STORE(density_at(marked, c, p).density, c, density);
  }
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
kernel void snap_points(global const Kernel* restrict kernels, global const Group* restrict groups,
                        global const uint* restrict list, global const float* restrict boxes,
                        global NearKernel* restrict all_near, global uint* restrict all_marks,
                        float threshold, int steps, global float* restrict xs,
                        global float* restrict ys, global float* restrict zs,
                        global float* restrict nxs, global float* restrict nys,
                        global float* restrict nzs) {
  const Marked marked = mark(kernels, groups, list, boxes, all_near, all_marks);
  global const Group* group = marked.group;
  FOR_EACH_CHUNK(c) {
    const int corners = steps + 8, end = steps > 0 ? corners + HALVINGS : 0;
    Real3 p = {LOAD(c, xs), LOAD(c, ys), LOAD(c, zs)};
    const Real3 low = {floor(p.x), floor(p.y), floor(p.z)};
    Vertex best = {p, p, REAL(INFINITY)};
    truth off = REAL(0.0f) == REAL(0.0f);
    real share = REAL(1.0f);
    Real3 way = {REAL(0.0f), REAL(0.0f), REAL(0.0f)};  // to the corner
    real nearest = REAL(INFINITY), before = REAL(0.0f), behind = REAL(1.0f), t = REAL(0.5f);
    Vertex start = best;
    for (int i = 0;; ++i) {
      const Sample s = density_at(marked, c, p);
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
    STORE(best.at.x, c, xs);
    STORE(best.at.y, c, ys);
    STORE(best.at.z, c, zs);
    const real steepness = square(best.gradient);
    const real scale = select(-rsqrt(steepness), REAL(0.0f), steepness < REAL(1e-30f));
    const Real3 normal = scaled(best.gradient, scale);
    STORE(normal.x, c, nxs);
    STORE(normal.y, c, nys);
    STORE(normal.z, c, nzs);
  }
}
