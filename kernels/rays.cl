// SPDX-License-Identifier: Apache-2.0
// Rays against the surface N = T: no polygons.
//
// Space is root blocks of 32 samples; a root is outside, inside or 64 bricks of 8 samples, each
// outside, inside or evaluated. In an evaluated brick N comes from the kernels near it, or where
// SAMPLED is defined from its samples, trilinearly. Along a ray xi of a kernel is a parabola
// (Kanamori et al., "GPU-based Fast Ray Casting for a Large Number of Metaballs", 2008, call what
// is near a ray its active list); N is summed at STEPS points of a ray's way through a brick, and
// the piece where it passes T is cut again, until it is short.
//
// On a CPU a work-item takes LANES = 16 rays, neighbours that meet the same bricks; on a GPU one
// (LANES = 1). Positions are voxels from the lattice's anchor, directions unit vectors.
// Global size: the number of rays over LANES, or more.
#include "density.clh"

#ifndef LANES
#define LANES 16
#endif

#if LANES == 16
typedef float16 real;
typedef int16 truth;
#define ANY(c) any_of(c)
#define TRUE ((truth)(-1))
#else
typedef float real;
typedef int truth;
#define ANY(c) (c)
#define TRUE 1
#endif
#define REAL(x) ((real)(x))
#define FALSE ((truth)(0))

#if LANES == 16
// In place of any(), of which PoCL makes a branch per lane.
static int any_of(int16 c) {
  const int8 c8 = c.lo | c.hi;
  const int4 c4 = c8.lo | c8.hi;
  const int2 c2 = c4.lo | c4.hi;
  return c2.x | c2.y;
}
#endif

typedef union {
  real v;
  float lane[LANES];
} Reals;
typedef union {
  truth v;
  int lane[LANES];
} Truths;

typedef struct {
  real x, y, z;
} Real3;

static Real3 along(Real3 from, Real3 way, real t) {
  return (Real3){fma(t, way.x, from.x), fma(t, way.y, from.y), fma(t, way.z, from.z)};
}

// ---- Space ----

#define ROOT_EDGE 32
#define OUTSIDE (-1)
#define INSIDE (-2)

// `BrickGrid` of the host.
typedef struct {
  int low[3];                   // the first root block, in roots
  int size[3];                  // roots along each axis
  global const int* roots;      // OUTSIDE, INSIDE or the first of 64 in `children`
  global const int* children;   // OUTSIDE, INSIDE or a brick
  global const float* samples;  // N, BRICK_SAMPLES to a brick
  global const uint* drawn;     // cells, a bit each, in which the surface is drawn
  global const uint* near;      // and those around them
} Grid;

#define GRID_ARGUMENTS                                                                        \
  int4 low, int4 size, global const int *restrict roots, global const int *restrict children, \
      global const float *restrict samples, global const uint *restrict drawn,                \
      global const uint *restrict near
#define GRID \
  { {low.x, low.y, low.z}, {size.x, size.y, size.z}, roots, children, samples, drawn, near }

typedef struct {
  int low[3];
  int edge;
  int content;  // OUTSIDE, INSIDE or a brick
} Block;

static int root_at(const Grid* g, int x, int y, int z) {
  const int i = (x >> 5) - g->low[0], j = (y >> 5) - g->low[1], k = (z >> 5) - g->low[2];
  const int within =
      (i >= 0) & (i < g->size[0]) & (j >= 0) & (j < g->size[1]) & (k >= 0) & (k < g->size[2]);
  return within ? g->roots[(i * g->size[1] + j) * g->size[2] + k] : OUTSIDE;
}

static int child_at(const Grid* g, int root, int x, int y, int z) {
  return g->children[root + ((x >> 3 & 3) * 4 + (y >> 3 & 3)) * 4 + (z >> 3 & 3)];
}

// What holds a cell.
static Block block_at(const Grid* g, int x, int y, int z) {
  Block b;
  b.content = root_at(g, x, y, z);
  b.edge = ROOT_EDGE;
  if (b.content >= 0) {
    b.content = child_at(g, b.content, x, y, z);
    b.edge = BRICK_EDGE;
  }
  b.low[0] = x & -b.edge;
  b.low[1] = y & -b.edge;
  b.low[2] = z & -b.edge;
  return b;
}

// The number of a cell or sample in its brick.
static int in_brick(int x, int y, int z) { return ((x & 7) * 8 + (y & 7)) * 8 + (z & 7); }

static int has_bit(global const uint* mask, int brick, int cell) {
  return mask[brick * (BRICK_SAMPLES / 32) + (cell >> 5)] >> (cell & 31) & 1;
}

static float sample_at(const Grid* g, float threshold, int x, int y, int z) {
  const int content = block_at(g, x, y, z).content;
  return content == OUTSIDE  ? 0.0f
         : content == INSIDE ? threshold
                             : g->samples[content * BRICK_SAMPLES + in_brick(x, y, z)];
}

// N between the samples, trilinearly.
static float sampled_density(const Grid* g, float threshold, float x, float y, float z) {
  const float fx = floor(x), fy = floor(y), fz = floor(z);
  const int i = (int)fx, j = (int)fy, k = (int)fz;
  float n[8];
  if (((i & 7) < 7) & ((j & 7) < 7) & ((k & 7) < 7)) {
    const int content = block_at(g, i, j, k).content;
    if (content == OUTSIDE) return 0.0f;
    if (content == INSIDE) return threshold;
    global const float* s = g->samples + content * BRICK_SAMPLES + in_brick(i, j, k);
    for (int c = 0; c < 8; ++c) n[c] = s[(c >> 2) * 64 + (c >> 1 & 1) * 8 + (c & 1)];
  } else {
    for (int c = 0; c < 8; ++c) {
      n[c] = sample_at(g, threshold, i + (c >> 2), j + (c >> 1 & 1), k + (c & 1));
    }
  }
  const float tx = x - fx, ty = y - fy, tz = z - fz;
  for (int c = 0; c < 4; ++c) n[c] = fma(tx, n[c + 4] - n[c], n[c]);
  for (int c = 0; c < 2; ++c) n[c] = fma(ty, n[c + 2] - n[c], n[c]);
  return fma(tz, n[1] - n[0], n[0]);
}

// ---- A ray's way through a brick ----

// Points on the way at which N is summed, both ends included.
#define STEPS 16
#define PIECES (STEPS - 1)
// A piece with a crossing, voxels; in it N goes straight.
#define CLOSE_ENOUGH 0.02f
// Points that cut a piece.
#define CUTS 3

// Kernels that a way through a brick may be remembered to meet.
#define MOST_MET (LANES == 16 ? 256 : 128)
// Those of a brick's list that are tried at once.
#define RUN 128

// A kernel along a ray: 1 - xi = top - (first + i more)^2 at the point i of its way.
typedef struct {
  real top, first, more;
} Parabola;

// Where N comes from in a brick.
typedef struct {
  int low[3];  // its origin: positions count from there
  global const Kernel* kernels;
  global const float4* balls;  // around each: centre, from the anchor, and radius, voxels
  global const uint* list;     // of those near it
  uint count;
  int knows_all;  // the kernels that a way meets, once it is known: met_count of the list
  uint met_count;
  uint met[MOST_MET + 1];
  Parabola parabolas[MOST_MET + 1];
  const Grid* grid;
  float threshold;
} Source;

// A ray and how far from it its neighbours are, at most, on the same way.
typedef struct {
  float x, y, z, dx, dy, dz, length, width;
} Beam;

#ifdef SAMPLED

static float sampled_near(const Source* s, float x, float y, float z) {
  return sampled_density(s->grid, s->threshold, x + (float)s->low[0], y + (float)s->low[1],
                         z + (float)s->low[2]);
}

static void sum_way(Source* s, Real3 p, Real3 d, real step, Beam beam, real* n) {
  (void)beam;
  for (int i = 0; i < STEPS; ++i) {
    const Real3 q = along(p, d, step * (float)i);
    n[i] = sampled_near(s, q.x, q.y, q.z);
  }
}

static void sum_cuts(const Source* s, Real3 p, Real3 d, real step, real begin, float width,
                     real* n) {
  for (int i = 0; i < CUTS; ++i) {
    const Real3 q = along(p, d, step * fma((float)(i + 1), width, begin));
    n[i] = sampled_near(s, q.x, q.y, q.z);
  }
}

// By differences over two voxels: smoother than the slope of a trilinear cell.
static Real3 gradient_at(const Source* s, Real3 p) {
  return (Real3){sampled_near(s, p.x + 1, p.y, p.z) - sampled_near(s, p.x - 1, p.y, p.z),
                 sampled_near(s, p.x, p.y + 1, p.z) - sampled_near(s, p.x, p.y - 1, p.z),
                 sampled_near(s, p.x, p.y, p.z + 1) - sampled_near(s, p.x, p.y, p.z - 1)};
}

#else

typedef struct {
  float x, y, z;
} Centre;

static Centre centre_of(const Source* s, global const Kernel* k) {
  return (Centre){(float)(k->cell[0] - s->low[0]) + k->offset[0],
                  (float)(k->cell[1] - s->low[1]) + k->offset[1],
                  (float)(k->cell[2] - s->low[2]) + k->offset[2]};
}

// U v
static Real3 transformed(global const Kernel* k, Real3 v) {
  return (Real3){fma(REAL(k->xx), v.x, fma(REAL(k->xy), v.y, k->xz * v.z)),
                 fma(REAL(k->yy), v.y, k->yz * v.z), k->zz * v.z};
}

static real dot3(Real3 a, Real3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }

// The kernels of the way, or where they were too many those of the brick.
static uint count_of(const Source* s) { return s->knows_all ? s->met_count : s->count; }
static global const Kernel* kernel_of(const Source* s, uint i) {
  return s->kernels + (s->knows_all ? s->met[i] : s->list[i]);
}

// The kernel along p + i step d. With q the point nearest to its centre, at s: 1 - xi =
// (1 - |U q|^2) - |U d|^2 (t - s)^2, where no large numbers cancel however thin the kernel is.
static Parabola parabola_along(const Source* source, global const Kernel* k, Real3 p, Real3 d,
                               real step) {
  const Centre c = centre_of(source, k);
  const Real3 from = transformed(k, (Real3){p.x - c.x, p.y - c.y, p.z - c.z});
  const Real3 way = transformed(k, d);
  const real steepness = dot3(way, way);
  const real s = -dot3(from, way) / steepness;
  const Real3 q = along(from, way, s);
  const real slope = sqrt(steepness);
  return (Parabola){1.0f - dot3(q, q), -s * slope, step * slope};
}

static real weight_at(Parabola k, real i) {
  const real u = fma(i, k.more, k.first);
  return fmax(fma(-u, u, k.top), REAL(0.0f));
}

// Whether the kernel is met on the way.
static int is_met(Parabola k) {
  const real last = fma(REAL((float)PIECES), k.more, k.first);
  const real beyond = fmax(fmax(k.first, -last), REAL(0.0f));
  return ANY(fma(-beyond, beyond, k.top) > 0.0f) != 0;
}

typedef struct {
  real x, y, z, radius;
} Balls;

static Balls balls_of(const Source* source, const uint* ranks) {
  global const float4* balls = source->balls;
#if LANES == 16
  float16 four[4];
  for (int i = 0; i < 4; ++i) {
    four[i] = (float16)(balls[ranks[4 * i]], balls[ranks[4 * i + 1]], balls[ranks[4 * i + 2]],
                        balls[ranks[4 * i + 3]]);
  }
#define OF_ALL(s) (float16)(four[0].s, four[1].s, four[2].s, four[3].s)
  return (Balls){OF_ALL(s048c), OF_ALL(s159d), OF_ALL(s26ae), OF_ALL(s37bf)};
#undef OF_ALL
#else
  const float4 ball = balls[ranks[0]];
  return (Balls){ball.x, ball.y, ball.z, ball.w};
#endif
}

// Writes down those kernels of a run of the list which the beam may meet: how many. LANES are
// tried at once.
static uint find_candidates(const Source* source, uint begin, uint end, Beam beam,
                            uint* candidates) {
  uint count = 0;
  for (uint i = begin; i < end; i += LANES) {
    uint ranks[LANES];
    for (int lane = 0; lane < LANES; ++lane) ranks[lane] = source->list[min(i + lane, end - 1)];
    const Balls balls = balls_of(source, ranks);
    const real x = balls.x - beam.x, y = balls.y - beam.y, z = balls.z - beam.z;
    const real ahead = fma(x, beam.dx, fma(y, beam.dy, z * beam.dz));
    const real reach = balls.radius + beam.width;
    const real aside = fma(x, x, fma(y, y, fma(z, z, -ahead * ahead)));
    const Truths meets = {.v = (aside < reach * reach) & (ahead > -reach) &
                               (ahead < beam.length + reach) & TRUE};
    if (!ANY(meets.v)) continue;
    const int last = min((uint)LANES, end - i);
    for (int lane = 0; lane < last; ++lane) {
      candidates[count] = ranks[lane];
      count += meets.lane[lane] & 1;
    }
  }
  return count;
}

// N at the points of a way; from then on the source knows what it meets.
static void sum_way(Source* source, Real3 p, Real3 d, real step, Beam beam, real* n) {
  for (int i = 0; i < STEPS; ++i) n[i] = REAL(0.0f);
  source->met_count = 0;
  source->knows_all = 1;
  for (uint begin = 0; begin < source->count; begin += RUN) {
    uint candidates[RUN + 1];
    const uint count =
        find_candidates(source, begin, min(begin + RUN, source->count), beam, candidates);
    source->knows_all &= source->met_count + count <= MOST_MET;
    const uint first = source->knows_all ? source->met_count : 0;
    uint met = first;
    for (uint i = 0; i < count; ++i) {
      source->met[met] = candidates[i];
      source->parabolas[met] = parabola_along(source, source->kernels + candidates[i], p, d, step);
      met += is_met(source->parabolas[met]);
    }
    for (uint i = first; i < met; ++i) {
      const Parabola k = source->parabolas[i];
#define ADD(i) n[i] = ADD_POWER(n[i], weight_at(k, REAL((float)(i))));
      // clang-format off
      ADD(0) ADD(1) ADD(2) ADD(3) ADD(4) ADD(5) ADD(6) ADD(7)
      ADD(8) ADD(9) ADD(10) ADD(11) ADD(12) ADD(13) ADD(14) ADD(15)
      // clang-format on
#undef ADD
    }
    source->met_count = met;
  }
}

// N at the cuts of a piece of the way, `begin` and its parts' `width` counted in steps.
static void sum_cuts(const Source* source, Real3 p, Real3 d, real step, real begin, float width,
                     real* n) {
  const uint count = count_of(source);
  const real first = begin + width, second = begin + 2 * width, third = begin + 3 * width;
  n[0] = n[1] = n[2] = REAL(0.0f);
  for (uint j = 0; j < count; ++j) {
    const Parabola k = source->knows_all ? source->parabolas[j]
                                         : parabola_along(source, kernel_of(source, j), p, d, step);
    n[0] = ADD_POWER(n[0], weight_at(k, first));
    n[1] = ADD_POWER(n[1], weight_at(k, second));
    n[2] = ADD_POWER(n[2], weight_at(k, third));
  }
}

// The gradient of N, up to a positive factor.
static Real3 gradient_at(const Source* source, Real3 p) {
  Real3 g = {REAL(0.0f), REAL(0.0f), REAL(0.0f)};
  const uint count = count_of(source);
  for (uint i = 0; i < count; ++i) {
    global const Kernel* k = kernel_of(source, i);
    const Centre c = centre_of(source, k);
    const Real3 u = transformed(k, (Real3){p.x - c.x, p.y - c.y, p.z - c.z});
    const real w = fmax(1.0f - dot3(u, u), REAL(0.0f));
    if (!ANY(w > 0.0f)) continue;
#if FALLOFF == 1
    const real slope = select(REAL(0.0f), REAL(-1.0f), w > REAL(0.0f));
#elif FALLOFF == 2
    const real slope = -w;
#else
    const real slope = -w * w;
#endif
    g.x = fma(slope, k->xx * u.x, g.x);
    g.y = fma(slope, fma(REAL(k->xy), u.x, k->yy * u.y), g.y);
    g.z = fma(slope, fma(REAL(k->xz), u.x, fma(REAL(k->yz), u.y, k->zz * u.z)), g.z);
  }
  return g;
}

#endif

// Where N passes T between two of the points.
typedef struct {
  truth found;
  real piece;          // its number, or where it begins, in steps
  real before, after;  // N at its ends
  truth enters;
} Crossing;

// The first crossing, `inside` telling the side of the first point.
static Crossing first_crossing(const real* n, float threshold, truth inside) {
  Crossing c = {FALSE, REAL(0.0f), REAL(0.0f), REAL(0.0f), !inside};
  for (int i = 1; i < STEPS; ++i) {
    const truth passes = ((n[i] >= threshold) ^ inside) & !c.found & TRUE;
    c.piece = select(c.piece, REAL((float)(i - 1)), passes);
    c.before = select(c.before, n[i - 1], passes);
    c.after = select(c.after, n[i], passes);
    c.found |= passes;
  }
  return c;
}

// How far along p + t d N passes T: the piece with the crossing is cut again and again.
static real pin_down(const Source* source, Real3 p, Real3 d, real step, float threshold,
                     Crossing c) {
  float width = 1.0f;
  while (ANY(c.found & (step * width > CLOSE_ENOUGH))) {
    width /= (float)(CUTS + 1);
    real n[CUTS];
    sum_cuts(source, p, d, step, c.piece, width, n);
    // Where none of the cuts is on the other side, it is in the last part.
    truth open = TRUE;
    real part = REAL((float)CUTS), before = n[CUTS - 1], after = c.after;
    for (int i = 0; i < CUTS; ++i) {
      const truth passes = ((n[i] >= threshold) ^ !c.enters) & open & TRUE;
      part = select(part, REAL((float)i), passes);
      before = select(before, i == 0 ? c.before : n[max(i - 1, 0)], passes);
      after = select(after, n[i], passes);
      open &= !passes;
    }
    c.piece = fma(part, REAL(width), c.piece);
    c.before = before, c.after = after;
  }
  const real rise = c.after - c.before;
  const real share = select((threshold - c.before) / rise, REAL(0.5f), fabs(rise) < 1e-20f);
  return step * fma(clamp(share, 0.0f, 1.0f), width, c.piece);
}

// ---- Rays ----

// Steps over the edge of a block, voxels.
#define NUDGE 1e-3f
// Rounding in the test of a kernel against a beam, voxels.
#define BEAM_SLACK 1e-2f
// From a crossing that is not drawn to where the ray goes on.
#define PAST_HIDDEN 1e-2f

static real kept_from_zero(real d) { return select(d, REAL(1e-12f), fabs(d) < 1e-12f); }

// The first and the last of the points of the lanes' ways through a brick that lie near the
// surface; none: the first is behind the last.
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

// From the anchor.
static Beam beam_of(const Block* block, Real3 p, Real3 d, real step, truth lanes) {
  const Reals px = {.v = p.x}, py = {.v = p.y}, pz = {.v = p.z};
  const Reals dx = {.v = d.x}, dy = {.v = d.y}, dz = {.v = d.z};
  const int lane = first_of(lanes);
  Beam b = {px.lane[lane], py.lane[lane], pz.lane[lane], dx.lane[lane],
            dy.lane[lane], dz.lane[lane], 0.0f,          0.0f};
  const Reals length = {.v = select(REAL(0.0f), step * (float)PIECES, lanes)};
  for (int i = 0; i < LANES; ++i) b.length = fmax(b.length, length.lane[i]);
  // Two lines are farthest apart at an end of the way.
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

  // From here rays begin where they enter the grid, where floats are fine.
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
  truth inside = FALSE, known = entry > 0.0f;  // on which side of the surface
  Source source;
  source.kernels = kernels;
  source.balls = balls;
  source.grid = &grid;
  source.threshold = threshold;
  real t = REAL(0.0f);
  Reals distance = {.v = REAL(INFINITY)};
  Reals gradient[3] = {{.v = REAL(0.0f)}, {.v = REAL(0.0f)}, {.v = REAL(0.0f)}};

  while (ANY(active)) {
    const real ahead = t + NUDGE;
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
    // From the first point near the surface to the last, and to those beside them.
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

// How much of a light a ray of length `reach` does not get, 0 to 1: the highest of
// saturate((N - T) / soft) at points a voxel apart, N from the samples. A small `soft` tells
// whether it meets a place inside: shadow. T itself gives ambient occlusion, 1 - saturate of N
// above T. A work-item per ray.
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
  float most = 0.0f;
  int counts = 0;  // inside of what is drawn: its surface was passed
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
      if (block.content == INSIDE) most = 1.0f;
      float leaves = INFINITY;
      for (int a = 0; a < 3; ++a) {
        const float far = (float)(block.low[a] + (d[a] > 0.0f ? block.edge : 0));
        leaves = fmin(leaves, (far - o[a]) * inverse[a]);
      }
      t = fmax(leaves, t) + NUDGE;
    }
  }
  blocked[i] = most;
}
