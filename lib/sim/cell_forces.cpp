#include "sim/cell_forces.h"

#include <algorithm>
#include <cmath>

#include "sim/cell_state.h"

namespace ringhook {
namespace {

ContactSlot contactSlot(const CellState& cell, int index) {
  const mjContact& contact = cell.data->contact[index];
  mjtNum wrench[6];
  mj_contactForce(cell.model.get(), cell.data.get(), index, wrench);
  ContactSlot slot;
  slot.body[0] = cell.model->geom_bodyid[contact.geom1];
  slot.body[1] = cell.model->geom_bodyid[contact.geom2];
  slot.point_f = Eigen::Map<const Eigen::Vector3d>(contact.pos);
  slot.normal_f = Eigen::Map<const Eigen::Vector3d>(contact.frame);
  slot.normal_force = std::abs(wrench[0]);
  slot.friction_force = std::hypot(wrench[1], wrench[2]);
  return slot;
}

/// Adds one contact's force to the ring that takes part in it.
void addToRing(CellState& cell, const mjContact& contact, double force) {
  const int geoms[2] = {contact.geom1, contact.geom2};
  for (int side = 0; side < 2; ++side) {
    const int ring = cell.ring_of_geom[static_cast<std::size_t>(geoms[side])];
    const GeomOwner other = cell.owner[static_cast<std::size_t>(geoms[1 - side])];
    if (ring >= 0 && other == GeomOwner::hook) {
      cell.rings[static_cast<std::size_t>(ring)].hook_force += force;
    } else if (ring >= 0 && other == GeomOwner::tool) {
      cell.rings[static_cast<std::size_t>(ring)].gripper_force += force;
    }
  }
}

/// Force [N] that the weld puts on the held ring; a weld's first three rows are its translation.
double gripForce(const CellState& cell) {
  if (cell.held_ring < 0) {
    return 0.0;
  }
  const int weld = cell.rings[static_cast<std::size_t>(cell.held_ring)].grip;
  for (int row = 0; row < cell.data->nefc; ++row) {
    if (cell.data->efc_type[row] == mjCNSTR_EQUALITY && cell.data->efc_id[row] == weld) {
      return mju_norm3(cell.data->efc_force + row);
    }
  }
  return 0.0;
}

}  // namespace

void recordForces(CellState& cell) {
  for (RingSlot& ring : cell.rings) {
    ring.hook_force = 0.0;
    ring.gripper_force = 0.0;
  }
  cell.contacts.clear();
  for (int i = 0; i < cell.data->ncon; ++i) {
    const ContactSlot slot = contactSlot(cell, i);
    addToRing(cell, cell.data->contact[i], slot.normal_force);
    if (slot.normal_force > 0.0) {
      cell.contacts.push_back(slot);
    }
  }
  for (RingSlot& ring : cell.rings) {
    ring.hook_impulse += ring.hook_force * cell.options.physics_step;
    ring.gripper_impulse += ring.gripper_force * cell.options.physics_step;
    if (ring.place == RingPlace::gripper) {
      ring.peak_force_in_grip = std::max(ring.peak_force_in_grip, ring.hook_force);
    }
  }
  cell.grip_force = gripForce(cell);
}

}  // namespace ringhook
