// Any bytes as a Wavefront mesh: understood or refused, and what comes out of it is an edge model.

#include "fuzz/scratch_folder.h"
#include "tracking/edge_model.h"
#include "tracking/mesh_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  MeshModel model;
  bool made = false;
  const int result = fuzz::understoodOrRefused([&] {
    const std::string text(fuzz::textOf(data, size));
    model = modelFromMesh(parseObj(text, "fuzz.obj"), {}, "fuzz.obj");
    made = true;
  });
  if (made) {
    const EdgeModel edges = parseEdgeModel(caoText(model, "fuzz.obj"), "fuzz.cao");
    fuzz::require(edges.points.size() == model.points.size(), "every point is written");
    fuzz::require(!edges.edges.empty(), "a model has edges");
  }
  return result;
}
