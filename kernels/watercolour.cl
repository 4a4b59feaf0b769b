// SPDX-License-Identifier: Apache-2.0
// The passes of a watercolour over what a picture's pixels see: T. Luft and O. Deussen, "Real-Time
// Watercolor Illustrations of Plants Using a Blurred Depth Test", NPAR 2006; A. Bousseau et al.,
// "Interactive Watercolor Rendering with Temporal Coherence and Abstraction", NPAR 2006; S. E.
// Montesdeoca et al., "Edge- and Substrate-based Effects for Watercolor Stylization", 2017.
//
// Pigment is kept as its density d: pigment of colour C on white paper reflects C^d (Beer and
// Lambert). So C' = C^(1 + e) in the papers becomes d' = d (1 + e), and layers over one another add
// up -d ln C.
//
// Global size: the values of a plane / LANES; for `see`, `pad` and `develop`, one work-item per
// pixel.
#include "watercolour.clh"

// Makes planes from what pixels see. Values are sums over a pixel, so they are zero where it sees
// nothing. light: 0..1; the sky gives the share `sky`, the key light, wrapped by `wrap`, the rest.
kernel void see(int width, int height, int pitch, global const uchar* object,
                global const float* normal, global const float* position, global const float* depth,
                global const float* key, global const float* open, float lx, float ly, float lz,
                float sky, float wrap, global float* seen, global float* light, global float* far,
                global float* x, global float* y, global float* z) {
  const int column = get_global_id(0), row = get_global_id(1);
  const int to = row * pitch + column;
  const bool inside = column < width && row < height;
  const int from = inside ? row * width + column : 0;
  const bool any = inside && object[from] != 0;
  const float3 n = vload3(from, normal), p = vload3(from, position);
  const float facing = fma(n.x, lx, fma(n.y, ly, n.z * lz));
  const float direct = key[from] * clamp((facing + wrap) / (1.0f + wrap), 0.0f, 1.0f);
  const float lit = fma(sky, open[from] - direct, direct);
  seen[to] = any ? 1.0f : 0.0f;
  light[to] = any ? lit : 0.0f;
  far[to] = any ? depth[from] : 0.0f;
  x[to] = any ? p.x : 0.0f;
  y[to] = any ? p.y : 0.0f;
  z[to] = any ? p.z : 0.0f;
}

// Makes a plane of a picture's values; the padding is zero.
kernel void pad(int width, int height, int pitch, global const float* values, global float* out) {
  const int column = get_global_id(0), row = get_global_id(1);
  const bool inside = column < width && row < height;
  out[row * pitch + column] = inside ? values[row * width + column] : 0.0f;
}

// 1 - the light, over the visible part of each pixel.
kernel void darkness(image light, image seen, canvas out) {
  STORE(saturate(1.0f - share(LOAD(light), LOAD(seen))), out);
}

// The value that a pixel sees or, if it sees nothing but paint may reach it, its neighbours'.
kernel void extend(image seen, image value, image seen_near, image value_near, canvas out) {
  STORE(blend(share(LOAD(value_near), LOAD(seen_near)), LOAD(value), LOAD(seen)), out);
}

// The blurred depth test: v = 1 - smoothstep(0, d, z - blur(z)). Luft and Deussen 2006.
kernel void visibility(image far, image seen_around, image far_around, float reach, canvas out) {
  const real behind = LOAD(far) - share(LOAD(far_around), LOAD(seen_around));
  STORE(1.0f - smooth(REAL(0.0f), REAL(reach), behind), out);
}

// Masks a by b: a blend of a and a b by `amount`.
kernel void mask(image a, image b, float amount, canvas out) {
  STORE(LOAD(a) * fma(REAL(amount), LOAD(b) - 1.0f, REAL(1.0f)), out);
}

// Where a layer lies: a blurred image pushed through a smoothstep around `level`, narrow for wet on
// dry, wide for wet on wet (Luft and Deussen 2006), where `within` lets it. The paper moves the
// boundary by its height and by the sway of its grain (dry brush and wobble), leaves break it.
// lost: widens the smoothstep where `wetness` is high, so that edges are lost and found.
kernel void layer(image rho, image within, image height, image sway, image breaking, image wetness,
                  float level, float softness, float lost, float dryness, float wobble,
                  float ragged, canvas out) {
  const real r = LOAD(rho);
  const real moved = fma(REAL(dryness), LOAD(height) - 0.5f,
                         fma(REAL(wobble), LOAD(sway), ragged * LOAD(breaking)));
  const real painted = saturate(8.0f * r);  // no paint moves to places without any
  const real half_width = fma(REAL(lost), saturate(LOAD(wetness)), REAL(softness));
  // However soft an edge is, there is no paint where rho is zero.
  const real low = fmax(level - half_width, REAL(0.0f));
  STORE(LOAD(within) * smooth(low, level + half_width, fma(painted, moved, r)), out);
}

// Pigment is carried to the rim while a layer dries: more where the layer is denser than its
// surroundings. After Bousseau et al. 2006, with the difference from a blur as the gradient.
kernel void darken_edges(image alpha, image around, float amount, canvas density) {
  const real a = LOAD(alpha);
  STORE(a * fma(REAL(amount), fmax(a - LOAD(around), REAL(0.0f)), REAL(1.0f)), density);
}

// Varies the density by the turbulence of the water (Bousseau et al. 2006), adds backruns where
// water flowed back and left its pigment along a front, and thins it where the light is brightest.
kernel void dilute(canvas density, image turbulence, image dark, float turbulent, float backruns,
                   float dilution) {
  const real t = LOAD(turbulence);
  const real front = smooth(REAL(0.0f), REAL(0.03f), t) * smooth(REAL(0.25f), REAL(0.03f), t);
  const real stirred = fma(REAL(turbulent), t, fma(REAL(backruns), front, REAL(1.0f)));
  const real bright = smooth(REAL(0.3f), REAL(0.85f), 1.0f - LOAD(dark));
  STORE(LOAD(density) * fmax(stirred, REAL(0.1f)) * (1.0f - dilution * bright), density);
}

// Pigment settles in the valleys of the paper, the more the denser it is: a (1 - h), Montesdeoca et
// al. 2017, less what the peaks lose. It is dispersed in specks (Bousseau et al. 2006).
kernel void granulate(canvas density, image height, image speckle, float granulation,
                      float dispersion) {
  const real d = LOAD(density);
  const real settled = granulation * (0.65f - LOAD(height));
  const real more = saturate(d) * fma(REAL(dispersion), LOAD(speckle), settled);
  STORE(d * fmax(1.0f + more, REAL(0.4f)), density);
}

// Lays a layer over the ones before: absorbance += density * (-ln C), C between a cool and a warm
// pigment.
kernel void glaze(image density, image warmth, float4 cool, float4 warm, float warm_cool,
                  canvas red, canvas green, canvas blue) {
  const real d = LOAD(density);
  const real t = saturate(fma(REAL(warm_cool), LOAD(warmth), REAL(0.5f)));
  STORE(fma(d, blend(REAL(cool.x), REAL(warm.x), t), LOAD(red)), red);
  STORE(fma(d, blend(REAL(cool.y), REAL(warm.y), t), LOAD(green)), green);
  STORE(fma(d, blend(REAL(cool.z), REAL(warm.z), t), LOAD(blue)), blue);
}

// How wet the paper is in patches, where there is paint.
kernel void wet(image wetness, image alpha, float amount, canvas out) {
  const real patch = smooth(REAL(-0.1f), REAL(0.5f), LOAD(wetness));
  STORE(saturate(amount * patch) * LOAD(alpha), out);
}

// Colours run into each other where the paper is wet. Montesdeoca et al. 2017.
kernel void bleed(canvas absorbance, image around, image wet) {
  const real a = LOAD(absorbance);
  STORE(blend(a, LOAD(around), saturate(LOAD(wet))), absorbance);
}

// The sRGB of paper and paint. shading: how strong the paper's relief is, Montesdeoca et al. 2017.
kernel void develop(int width, int pitch, global const float* red, global const float* green,
                    global const float* blue, global const float* relief, float4 paper,
                    float shading, global uchar* rgb) {
  const int column = get_global_id(0), row = get_global_id(1);
  const int i = row * pitch + column;
  const float3 absorbance = {red[i], green[i], blue[i]};
  const float lamp = fma(shading, relief[i] - 1.0f, 1.0f);
  const float3 color = 255.0f * lamp * paper.xyz * exp(-absorbance);
  vstore3(convert_uchar3_sat_rte(color), row * width + column, rgb);
}
