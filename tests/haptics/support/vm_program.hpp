// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of the tests in the virtual machine of ./run devices-vm: the program, and waits in
// the time of an emulated machine, which is slow and uneven.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace reckon::test {

inline constexpr const char* kProgram = "/bin/reckon";

inline bool comes_true(const std::function<bool()>& what,
                       std::chrono::seconds longest = std::chrono::seconds(30)) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (std::chrono::steady_clock::now() < end) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

inline double milliseconds_of(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

inline double milliseconds_until(const std::function<bool()>& what) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(comes_true(what));
  return milliseconds_of(std::chrono::steady_clock::now() - begin);
}

/// The program, with its output in a file.
class Program {
 public:
  /// @param user runs it
  explicit Program(std::vector<std::string> words, uid_t user = 0)
      : words_(std::move(words)), user_(user) {
    words_.insert(words_.begin(), kProgram);
    std::filesystem::remove(file_);
    id_ = ::fork();
    if (id_ == 0) run();
  }
  ~Program() {
    if (id_ <= 0) return;
    send(SIGKILL);
    static_cast<void>(wait());
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const { ::kill(id_, signal); }
  /// @return its exit status, as in a shell
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(id_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  [[nodiscard]] std::string said() const {
    std::ifstream in(file_);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  [[nodiscard]] bool has_said(const std::string& text) const {
    return said().find(text) != std::string::npos;
  }

 private:
  [[noreturn]] void run() {
    const int file = ::open(file_.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    if (user_ != 0 && ::setuid(user_) != 0) std::_Exit(126);
    std::vector<char*> arguments;
    for (std::string& word : words_) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(arguments[0], arguments.data());
    std::_Exit(127);
  }

  std::vector<std::string> words_;
  uid_t user_;
  std::string file_ = "/tmp/said";
  pid_t id_ = 0;
};

}  // namespace reckon::test
