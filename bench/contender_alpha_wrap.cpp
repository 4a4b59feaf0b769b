// SPDX-License-Identifier: Apache-2.0
// CGAL's alpha wrap of the leaf vertices as a point set: a surface that balls of radius alpha
// cannot pass. alpha is the case's R; the surface lies alpha / 30 from the points, CGAL's own
// default. It has no field and knows one thread.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/version.h>

#include "bench/contender.h"

namespace leafhull::bench {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Json run(const std::vector<Point>& points, double alpha) {
  CGAL::Surface_mesh<Point> mesh;
  const double seconds = seconds_of([&] { CGAL::alpha_wrap_3(points, alpha, alpha / 30, mesh); });
  return {{"field", nullptr},
          {"mesh", seconds},
          {"total", seconds},
          {"vertices", mesh.number_of_vertices()},
          {"faces", mesh.number_of_faces()}};
}

Contender prepare(const Case& c) {
  std::vector<Point> points;
  points.reserve(c.count);
  for (const Vec3d p : read_points(c)) points.emplace_back(p.x, p.y, p.z);
  Contender contender{.name = "CGAL alpha_wrap_3", .version = CGAL_VERSION_STR};
  contender.run = [points = std::move(points), alpha = c.radius] { return run(points, alpha); };
  return contender;
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("CGAL's alpha_wrap_3; --threads changes nothing, it knows one.");
  return leafhull::bench::serve(app, argc, argv,
                                [](const auto& c, int) { return leafhull::bench::prepare(c); });
}
