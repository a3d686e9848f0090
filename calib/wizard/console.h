#pragma once

/// \file
/// A dialogue on a plain terminal: one question at a time, a proposal in brackets that Enter takes,
/// and a sentence instead of a wrong answer. Reads a file descriptor, not a stream, so that Ctrl-C
/// ends a question that nobody answers.

#include <functional>
#include <optional>
#include <string>

namespace ringhook {

class Console {
 public:
  /// What is wrong with an answer, in one sentence; empty if nothing is.
  using Check = std::function<std::string(const std::string&)>;

  /// \param input where answers are read: 0 for the terminal. \param output where text goes: 1.
  /// \param step called while an answer is waited for, ten times a second; may throw.
  Console(int input, int output, std::function<void()> step);

  /// A line, or several with line breaks between.
  void say(const std::string& text);

  /// The answer without blanks around it, or `proposal` for an empty one. Asks again, with the
  /// check's sentence, until the check is content. Throws Interrupted when the input ends, and
  /// whatever `step` throws.
  std::string ask(const std::string& question, const std::string& proposal,
                  const Check& check = {});

  /// Yes or no; `proposal` for an empty answer.
  bool confirm(const std::string& question, bool proposal);

 private:
  std::optional<std::string> readLine();

  int input_;
  int output_;
  std::function<void()> step_;
  std::string pending_;  ///< read, but behind the last line break
};

}  // namespace ringhook
