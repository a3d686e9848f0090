#include "tests/support/tiny_disk.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <fstream>

namespace ringhook::test {
namespace {

constexpr int kImpossible = 77;

bool mountDisk(const std::filesystem::path& folder, std::size_t bytes) {
  const std::string user = std::to_string(geteuid());
  const std::string group = std::to_string(getegid());
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) {
    return false;
  }
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << "0 " + user + " 1";
  std::ofstream("/proc/self/gid_map") << "0 " + group + " 1";
  return mount("tmpfs", folder.c_str(), "tmpfs", 0, ("size=" + std::to_string(bytes)).c_str()) == 0;
}

[[noreturn]] void runChild(const std::filesystem::path& folder, std::size_t bytes,
                           const std::function<void()>& job) {
  if (!mountDisk(folder, bytes)) {
    _exit(kImpossible);
  }
  int code = 0;
  try {
    job();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "on the tiny disk: %s\n", e.what());
    code = 1;
  }
  std::fflush(nullptr);
  _exit(::testing::Test::HasFailure() ? 1 : code);
}

}  // namespace

TinyDiskResult runOnTinyDisk(const std::filesystem::path& folder, std::size_t bytes,
                             const std::function<void()>& job) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    runChild(folder, bytes, job);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) {
    return {};
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return {code != kImpossible, code == 0};
}

}  // namespace ringhook::test
