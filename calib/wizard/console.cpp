#include "calib/wizard/console.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kPollMs = 100;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

Console::Console(int input, int output, std::function<void()> step)
    : input_(input), output_(output), step_(std::move(step)) {}

void Console::say(const std::string& text) {
  const std::string line = text + "\n";
  std::size_t sent = 0;
  while (sent < line.size()) {
    const ssize_t count = ::write(output_, line.data() + sent, line.size() - sent);
    if (count < 0 && errno != EINTR) {
      throw Error("the terminal is gone");
    }
    sent += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
}

std::optional<std::string> Console::readLine() {
  while (true) {
    const auto end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      return line;
    }
    step_();
    pollfd waiting{input_, POLLIN, 0};
    if (::poll(&waiting, 1, kPollMs) <= 0) {
      continue;
    }
    std::array<char, 256> bytes{};
    const ssize_t count = ::read(input_, bytes.data(), bytes.size());
    if (count == 0 || (count < 0 && errno != EINTR)) {
      return std::nullopt;
    }
    pending_.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
}

std::string Console::ask(const std::string& question, const std::string& proposal,
                         const Check& check) {
  while (true) {
    say(question + (proposal.empty() ? "" : " [" + proposal + "]"));
    const std::optional<std::string> line = readLine();
    if (!line) {
      throw Interrupted("the input ended before the wizard did; the session is kept");
    }
    std::string answer = trimmed(*line);
    if (answer.empty()) {
      answer = proposal;
    }
    const std::string fault = check ? check(answer) : "";
    if (fault.empty()) {
      return answer;
    }
    say(fault);
  }
}

bool Console::confirm(const std::string& question, bool proposal) {
  const auto yesOrNo = [](const std::string& answer) -> std::string {
    return answer == "y" || answer == "yes" || answer == "n" || answer == "no"
               ? ""
               : "Please answer y or n.";
  };
  return ask(question, proposal ? "y" : "n", yesOrNo).front() == 'y';
}

}  // namespace ringhook
