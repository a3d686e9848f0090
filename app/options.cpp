#include "app/options.h"

namespace ringhook {

CLI::App& addCommand(CLI::App& parent, const std::string& name, const std::string& what,
                     const std::string& footer) {
  CLI::App* command = parent.add_subcommand(name, what);
  command->footer(footer);
  return *command;
}

void addJsonOption(CLI::App& command, std::string& file, const std::string& what) {
  command.add_option("--json", file, what)->type_name("FILE");
}

JsonFile::JsonFile(const std::string& file) {
  if (!file.empty()) {
    file_.emplace(file);
  }
}

void JsonFile::commit(const std::string& text) {
  if (file_) {
    file_->stream() << text;
    file_->commit();
  }
}

}  // namespace ringhook
