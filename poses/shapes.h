// Small shapes whose transfer is known in closed form. The number of vertices is the nearest one
// that the shape's grid can have.
//
//  sphere  A closed unit sphere about the origin (geodesic). It is convex, so nothing is shadowed,
//          and the transfer is â_l y_i(n) with n = position / radius. Poses: the radius swings 0.75
//          … 1.25.
//  box     The closed cube [−1, 1]³. It is convex, so nothing is shadowed; inside a face n is the
//          face's normal. Poses: one turn about Y.
//  plates  Two single square sheets [−1, 1]² at y = ±distance/2, facing each other. From a point of
//          one, the other blocks the form factor of a point that faces a parallel rectangle
//          (plates_blocked). Poses: the distance swings 0.5 … 1.5, starting with 1.
//  cavity  The cube [−1, 1]³ seen from inside, faces inwards. No vertex sees sky: transfer is 0.
//          Poses: one turn about Y.
//  bowl    A single sheet: the lower half of the unit sphere, faces inwards, open at y = 0. The
//          form factor between any two patches of a sphere is area / (4π), so the hemisphere hides
//          exactly half of the cosine-weighted sky of every point: t_00 = y_00 / 2 everywhere, also
//          on the rim. For flat triangles this holds up to their sagitta, O(1/V). Poses: the radius
//          swings 0.75 … 1.25.
// Based on: Howell, A Catalog of Radiation Heat Transfer Configuration Factors (plates: B-4, bowl:
//           the inside of a sphere)
#pragma once

#include <memory>

#include "poses/sequence.h"

namespace paim::poses {

constexpr uint32_t kMinShapeVertices = 50;
constexpr uint32_t kMaxShapeVertices = 2'000'000;

// num_vertices outside kMin … kMaxShapeVertices: Error(usage).
std::unique_ptr<Sequence> make_sphere_sequence(uint32_t num_vertices);
std::unique_ptr<Sequence> make_box_sequence(uint32_t num_vertices);
std::unique_ptr<Sequence> make_plates_sequence(uint32_t num_vertices);
std::unique_ptr<Sequence> make_cavity_sequence(uint32_t num_vertices);
std::unique_ptr<Sequence> make_bowl_sequence(uint32_t num_vertices);

// Distance of the plates, scene units, in pose p.
double plates_distance(uint32_t p, uint32_t num_poses);

// Share of the cosine-weighted half-space that the other plate hides from the point (x, z) of one.
double plates_blocked(double x, double z, double distance);

// Radius of the sphere and of the bowl in pose p.
double pulsing_radius(uint32_t p, uint32_t num_poses);

}  // namespace paim::poses
