#include "program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ringhook::test {
namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// In the new process: becomes the program.
[[noreturn]] void become(std::vector<std::string> words, const std::filesystem::path& folder,
                         const std::filesystem::path& out_file, int err_pipe) {
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  const int out = open(out_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(out, STDOUT_FILENO);
  dup2(err_pipe, STDERR_FILENO);
  if (chdir(folder.c_str()) == 0) {
    execv(argv[0], argv.data());
  }
  _exit(127);
}

}  // namespace

Program::Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments)
    : out_file_(folder / "stdout.txt") {
  std::vector<std::string> words = {RINGHOOK_BINARY_DIR "/ringhook"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw std::runtime_error("cannot make a pipe");
  }
  pid_ = fork();
  if (pid_ == 0) {
    become(words, folder, out_file_, ends[1]);
  }
  close(ends[1]);
  err_pipe_ = ends[0];
  if (pid_ < 0) {
    throw std::runtime_error("cannot start a process");
  }
}

Program::~Program() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(err_pipe_);
}

bool Program::readMore() {
  char buffer[4096];
  const ssize_t count = read(err_pipe_, buffer, sizeof buffer);
  if (count > 0) {
    err_.append(buffer, static_cast<std::size_t>(count));
  }
  return count > 0;
}

bool Program::waitUntilItSays(const std::string& text) {
  while (err_.find(text) == std::string::npos) {
    if (!readMore()) {
      return false;
    }
  }
  return true;
}

bool Program::waitUntilThereIs(const std::filesystem::path& file) {
  constexpr int kLookAgain_ms = 5;
  while (!std::filesystem::exists(file)) {
    pollfd said{err_pipe_, POLLIN, 0};
    if (poll(&said, 1, kLookAgain_ms) > 0 && !readMore()) {
      return false;
    }
  }
  return true;
}

void Program::signal(int number) { kill(pid_, number); }

ProgramResult Program::wait() {
  while (readMore()) {
  }
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(out_file_), err_};
}

ProgramResult runProgram(const std::filesystem::path& folder,
                         const std::vector<std::string>& arguments) {
  return Program(folder, arguments).wait();
}

}  // namespace ringhook::test
