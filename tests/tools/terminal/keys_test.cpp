// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keys on a pseudo terminal, and its restoration whatever ends the program.
#include "reckon/tools/terminal/keys.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string>

#include "reckon/tests/tools/support/capture_verbs.hpp"

namespace reckon::tools::keys_test {
namespace {

using namespace captures;

/// A pseudo terminal: the screen and keyboard of a user.
class Terminal {
 public:
  Terminal() : person_(posix_openpt(O_RDWR | O_NOCTTY)) {
    EXPECT_EQ(grantpt(person_), 0);
    EXPECT_EQ(unlockpt(person_), 0);
    program_ = open(ptsname(person_), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    close(program_);
    close(person_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  [[nodiscard]] int program() const { return program_; }
  void type(const std::string& keys) const {
    EXPECT_EQ(write(person_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// Whether line mode and echo are as in a shell.
  [[nodiscard]] bool is_as_before() const {
    termios mode{};
    tcgetattr(program_, &mode);
    return (mode.c_lflag & ICANON) != 0 && (mode.c_lflag & ECHO) != 0;
  }
  /// Waits at most 10 s until the program has printed this text.
  [[nodiscard]] bool shows(const std::string& text) {
    pollfd entry{person_, POLLIN, 0};
    while (seen_.find(text) == std::string::npos) {
      std::array<char, 1000> buffer{};
      if (poll(&entry, 1, 10'000) <= 0) return false;
      const ssize_t count = read(person_, buffer.data(), buffer.size());
      if (count <= 0) return false;
      seen_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    seen_.clear();
    return true;
  }
  /// Called in a child: makes it stdin and stderr, but not the controlling terminal, which would
  /// lose its last output when its process ends.
  void adopt() const {
    dup2(program_, STDIN_FILENO);
    dup2(program_, STDERR_FILENO);
  }

 private:
  int person_;
  int program_ = -1;
  std::string seen_;
};

TEST(TerminalKeys, ReadTypedKeysWithoutEnter) {
  const Terminal terminal;
  {
    TerminalKeys keys(terminal.program());
    EXPECT_TRUE(keys.is_active());
    EXPECT_FALSE(terminal.is_as_before());
    terminal.type(" +");
    std::array<char, 8> out{};
    std::string typed;
    while (typed.size() < 2) typed.append(out.data(), keys.read(out, 10s));
    EXPECT_EQ(typed, " +");
    EXPECT_EQ(keys.read(out, 0s), 0U);
  }
  EXPECT_TRUE(terminal.is_as_before());
}

TEST(TerminalKeys, LeaveOtherFilesAlone) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "q", 1), 1);
  TerminalKeys keys(ends[0]);
  EXPECT_FALSE(keys.is_active());
  std::array<char, 8> out{};
  EXPECT_EQ(keys.read(out, 0s), 0U);
  close(ends[0]);
  close(ends[1]);
}

std::atomic<bool> replay_stop{false};
extern "C" void stop_replay(int) { replay_stop = true; }

/// A replay on a terminal, in a process of its own with the program's signal handlers.
class ReplayOnTerminal : public ::testing::Test {
 protected:
  void begin() {
    const std::string in = make_capture(folder, 2, 1h);
    child = fork();
    if (child == 0) {
      terminal.adopt();
      struct sigaction action {};
      action.sa_handler = stop_replay;
      action.sa_flags = SA_RESETHAND;
      sigaction(SIGINT, &action, nullptr);
      sigaction(SIGTERM, &action, nullptr);
      Console console;
      console.stop = &replay_stop;
      const std::array<std::string_view, 2> words{"replay", in};
      _exit(test::run_program(words, console));
    }
    EXPECT_TRUE(terminal.shows("keys: space pause"));
    EXPECT_TRUE(soon([&] { return !terminal.is_as_before(); }));
  }
  int end() {
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(terminal.is_as_before());
    return status;
  }

  ScratchFolder folder;
  Terminal terminal;
  pid_t child = -1;
};

TEST_F(ReplayOnTerminal, EndsInOrderAtCtrlCWhilePaused) {
  begin();
  terminal.type(" ");
  EXPECT_TRUE(terminal.shows("; paused"));
  kill(child, SIGINT);
  EXPECT_TRUE(terminal.shows("replayed 1 datagram "));
  const int status = end();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(ReplayOnTerminal, EndsByKey) {
  begin();
  terminal.type("+q");
  EXPECT_TRUE(terminal.shows("replayed 1 datagram "));
  EXPECT_EQ(end(), 0);
}

TEST_F(ReplayOnTerminal, LeapsBeyondTheEnd) {
  begin();
  std::string hour;
  for (int i = 0; i < 360; ++i) hour += "\x1b[C";
  terminal.type(hour);
  EXPECT_TRUE(terminal.shows("replayed 1 datagram "));
  EXPECT_EQ(end(), 0);
}

TEST_F(ReplayOnTerminal, GivesTheTerminalBackWhenKilled) {
  for (const int signal : {SIGQUIT, SIGHUP, SIGABRT}) {
    begin();
    kill(child, signal);
    const int status = end();
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), signal);
    std::filesystem::remove(folder.file("made.pcapng"));
  }
}

TEST_F(ReplayOnTerminal, GivesTheTerminalBackWhileItIsStopped) {
  begin();
  kill(child, SIGTSTP);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, WUNTRACED), child);
  EXPECT_TRUE(WIFSTOPPED(status));
  EXPECT_TRUE(terminal.is_as_before());
  kill(child, SIGCONT);
  EXPECT_TRUE(soon([&] { return !terminal.is_as_before(); }));
  terminal.type("q");
  EXPECT_EQ(end(), 0);
}

}  // namespace
}  // namespace reckon::tools::keys_test
