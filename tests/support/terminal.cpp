#include "tests/support/terminal.h"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

namespace ringhook::test {

Terminal::Terminal(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  const std::string program = RINGHOOK_BINARY_DIR "/ringhook";
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  pid_ = ::forkpty(&terminal_, nullptr, nullptr, nullptr);
  if (pid_ < 0) {
    throw std::runtime_error("no pseudo-terminal");
  }
  if (pid_ == 0) {
    if (::chdir(folder.c_str()) == 0) {
      ::execv(program.c_str(), words.data());
    }
    ::_exit(127);
  }
}

Terminal::~Terminal() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(terminal_);
}

bool Terminal::readMore() {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::read(terminal_, bytes.data(), bytes.size());
  if (count <= 0) {
    return false;
  }
  said_.append(bytes.data(), static_cast<std::size_t>(count));
  return true;
}

bool Terminal::waitFor(const std::string& text) {
  while (true) {
    const auto at = said_.find(text, heard_);
    if (at != std::string::npos) {
      heard_ = at + text.size();
      return true;
    }
    if (!readMore()) {
      return false;
    }
  }
}

void Terminal::type(const std::string& line) {
  const std::string bytes = line + "\n";
  if (::write(terminal_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the pseudo-terminal takes no more");
  }
}

void Terminal::signal(int number) { ::kill(pid_, number); }

int Terminal::wait() {
  while (readMore()) {
  }
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace ringhook::test
