#include "rig/opencv_text.h"

#include <libxml/parser.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

struct FreeDocument {
  void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};

void requireYaml(const std::string& text, const std::string& where) {
  try {
    // OpenCV's first line looks like a directive and is none.
    if (!YAML::Load(text.substr(std::min(text.find('\n'), text.size()))).IsMap()) {
      throw InputError(where + ": is not an OpenCV YAML file with keys at the top");
    }
  } catch (const YAML::Exception& e) {
    throw InputError(where + ", line " + std::to_string(e.mark.line + 1) +
                     ": is not YAML: " + e.msg);
  }
}

void requireXml(const std::string& text, const std::string& where) {
  const std::unique_ptr<xmlDoc, FreeDocument> document(
      xmlReadMemory(text.data(), static_cast<int>(text.size()), nullptr, nullptr,
                    XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING));
  const xmlNode* root = document ? xmlDocGetRootElement(document.get()) : nullptr;
  if (root == nullptr ||
      std::string_view(reinterpret_cast<const char*>(root->name)) != "opencv_storage") {
    throw InputError(where + ": is not XML with the root opencv_storage");
  }
}

}  // namespace

std::string readOpenCvText(const std::filesystem::path& path, OpenCvSyntax syntax) {
  const std::string where = path.string();
  if (!isFile(path)) {
    throw InputError(where + ": no such file");
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  std::string text = content.str();
  const bool xml = syntax == OpenCvSyntax::kYamlOrXml && text.starts_with("<?xml");
  if ((!xml && !text.starts_with("%YAML")) || text.find('\0') != std::string::npos) {
    throw InputError(where + (syntax == OpenCvSyntax::kYaml
                                  ? ": is not an OpenCV YAML file, whose first line is %YAML:1.0"
                                  : ": is not an OpenCV file, whose first line is %YAML:1.0 or "
                                    "<?xml ...>"));
  }
  xml ? requireXml(text, where) : requireYaml(text, where);
  return text;
}

}  // namespace ringhook
