#include "sim/mujoco_model.h"

#include <array>
#include <cstring>
#include <mutex>

#include "core/error.h"

namespace ringhook {
namespace {

void throwError(const char* message) {
  throw Error(std::string("The simulation failed: MuJoCo says \"") + message + "\".");
}

/// Warnings are counted in mjData, where checkHealth looks; MuJoCo's own handler writes a file.
void ignoreWarning(const char* /*message*/) {}

void installHandlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_error = throwError;
    mju_user_warning = ignoreWarning;
  });
}

}  // namespace

ModelPtr loadModel(const std::string& mjcf) {
  installHandlers();
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  constexpr const char* kName = "cell.xml";
  if (mj_makeEmptyFileVFS(vfs.get(), kName, static_cast<int>(mjcf.size())) != 0) {
    throw Error("The simulated cell could not be loaded: no room for its model in memory.");
  }
  std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), kName)], mjcf.data(), mjcf.size());
  std::array<char, 1000> message{};
  ModelPtr model(mj_loadXML(kName, vfs.get(), message.data(), static_cast<int>(message.size())));
  mj_deleteVFS(vfs.get());
  if (!model) {
    throw Error(std::string("The simulated cell's model is not valid: ") + message.data());
  }
  return model;
}

DataPtr makeData(const mjModel& model) {
  DataPtr data(mj_makeData(&model));
  if (!data) {
    throw Error("The simulated cell could not be loaded: out of memory.");
  }
  return data;
}

int findObject(const mjModel& model, mjtObj type, const std::string& name) {
  const int id = mj_name2id(&model, type, name.c_str());
  if (id < 0) {
    throw Error("The simulated cell's model has no object named " + name + ".");
  }
  return id;
}

void checkHealth(const mjData& data) {
  for (const mjtWarning kind : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL,
                                mjWARN_CONTACTFULL, mjWARN_CNSTRFULL}) {
    if (data.warning[kind].number > 0) {
      throw Error("The simulation failed at " + std::to_string(data.time) +
                  " s: " + mju_warningText(kind, data.warning[kind].lastinfo));
    }
  }
}

}  // namespace ringhook
