#include "sim/unit_meshes.h"

#include <cmath>
#include <numbers>

namespace ringhook {
namespace {

using Point = std::array<float, 3>;

void addVertex(UnitMesh& mesh, const Point& position, const Point& normal, float end) {
  mesh.vertices.push_back(
      {{position[0], position[1], position[2]}, {normal[0], normal[1], normal[2]}, end});
}

/// Two triangles a-b-c, a-c-d.
void addQuad(UnitMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

UnitMesh box() {
  UnitMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      Point normal{};
      normal[axis] = side;
      for (int corner = 0; corner < 4; ++corner) {
        Point p = normal;
        // Counter-clockwise about +axis, turned round for the other side.
        p[(axis + 1) % 3] = (corner == 0 || corner == 3) ? -side : side;
        p[(axis + 2) % 3] = corner < 2 ? -1.0F : 1.0F;
        addVertex(mesh, p, normal, 0.0F);
      }
      addQuad(mesh, first, first + 1, first + 2, first + 3);
    }
  }
  return mesh;
}

Point around(int slice, int slices, double radius, double z) {
  const double angle = 2.0 * std::numbers::pi * slice / slices;
  return {static_cast<float>(radius * std::cos(angle)),
          static_cast<float>(radius * std::sin(angle)), static_cast<float>(z)};
}

/// Joins ring `lower` to the ring above it.
void addBelt(UnitMesh& mesh, std::uint32_t lower, int slices) {
  for (int s = 0; s < slices; ++s) {
    const std::uint32_t a = lower + static_cast<std::uint32_t>(s);
    const std::uint32_t b = lower + static_cast<std::uint32_t>((s + 1) % slices);
    const auto up = static_cast<std::uint32_t>(slices);
    addQuad(mesh, a, b, b + up, a + up);
  }
}

/// Rings of latitude from the lower pole to the upper one, the equator twice.
UnitMesh capsule(int slices, int stacks) {
  UnitMesh mesh;
  for (int ring = 0; ring < 2 * stacks + 2; ++ring) {
    const bool lower = ring <= stacks;
    const double latitude =
        0.5 * std::numbers::pi * (lower ? ring - stacks : ring - stacks - 1) / stacks;
    for (int s = 0; s < slices; ++s) {
      const Point p = around(s, slices, std::cos(latitude), std::sin(latitude));
      addVertex(mesh, p, p, lower ? -1.0F : 1.0F);
    }
    if (ring > 0) {
      addBelt(mesh, static_cast<std::uint32_t>((ring - 1) * slices), slices);
    }
  }
  return mesh;
}

UnitMesh cylinder(int slices) {
  UnitMesh mesh;
  for (const double z : {-1.0, 1.0}) {
    for (int s = 0; s < slices; ++s) {
      addVertex(mesh, around(s, slices, 1.0, z), around(s, slices, 1.0, 0.0), 0.0F);
    }
  }
  addBelt(mesh, 0, slices);
  for (const int side : {-1, 1}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int s = 0; s < slices; ++s) {
      const auto z = static_cast<float>(side);
      addVertex(mesh, around(side * s, slices, 1.0, side), {0.0F, 0.0F, z}, 0.0F);
      const auto last = static_cast<std::uint32_t>(s);
      if (s >= 2) {
        mesh.indices.insert(mesh.indices.end(), {first, first + last - 1, first + last});
      }
    }
  }
  return mesh;
}

}  // namespace

UnitMesh unitMesh(SolidShape shape) {
  switch (shape) {
    case SolidShape::capsule:
      return capsule(40, 10);
    case SolidShape::wire:
      return capsule(10, 2);
    case SolidShape::cylinder:
      return cylinder(48);
    case SolidShape::slimCylinder:
      return cylinder(20);
    case SolidShape::rod:
      return cylinder(12);
    case SolidShape::box:
      break;
  }
  return box();
}

}  // namespace ringhook
