#pragma once

/// \file
/// What the subcommands have in common: a sentence and an example in their help, and results for
/// programs in a file that --json names.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "core/atomic_file.h"

namespace ringhook {

/// Registers a subcommand. \param what it is for, in one sentence. \param footer at the end of its
/// help: an example.
CLI::App& addCommand(CLI::App& parent, const std::string& name, const std::string& what,
                     const std::string& footer);

/// Registers --json FILE. \param what the file will hold.
void addJsonOption(CLI::App& command, std::string& file, const std::string& what);

/// The file that --json names. To be made before the work: a place that cannot be written is found
/// out then, not after it. Without commit() nothing is left of it.
class JsonFile {
 public:
  /// \param file empty for none. Throws InputError naming it if it cannot be written.
  explicit JsonFile(const std::string& file);

  /// Writes the text and gives the file its name. Throws Error (disk full).
  void commit(const std::string& text);

 private:
  std::optional<AtomicFile> file_;
};

}  // namespace ringhook
