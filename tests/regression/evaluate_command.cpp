#include "evaluate_command.h"

#include <algorithm>

#include "app/evaluate.h"
#include "core/error.h"

namespace ringhook {

CommandResult runEvaluate(std::vector<std::string> arguments) {
  CLI::App app{"test"};
  addEvaluateCommand(app);
  arguments.insert(arguments.begin(), "evaluate");
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    return {e.get_exit_code() == 0 ? 0 : 2, e.what()};
  } catch (const Error& e) {
    return {e.exitCode(), e.what()};
  }
  return {};
}

int filesBelow(const std::filesystem::path& folder) {
  int count = 0;
  if (std::filesystem::exists(folder)) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      count += entry.is_regular_file() ? 1 : 0;
    }
  }
  return count;
}

}  // namespace ringhook
