#include "default_cell.h"

#include "../../support/scratch_folder.h"

namespace ringhook::test {

std::filesystem::path defaultCellFile() { return RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml"; }

std::string defaultCellText() { return textOf(defaultCellFile()); }

CellConfig defaultCell() { return loadCellConfig(defaultCellFile()); }

StereoRig coarseRig(const CellConfig& cell) {
  StereoRig rig = loadRig(cell.rig);
  for (CameraModel* camera : {&rig.left, &*rig.right}) {
    camera->K.topRows<2>() /= 8.0;
    camera->width /= 8;
    camera->height /= 8;
  }
  return rig;
}

}  // namespace ringhook::test
