// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/supervisor.hpp"

#include "core/error.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <string>

// What runs after a fork of a program with threads allocates nothing and takes no lock.

namespace mapscore {
namespace {

constexpr int kReports = 3, kOut = 4, kErr = 5, kNull = 6, kFirstFree = 7;

void report(const SupervisorReport& what, int descriptor = kReports) {
  [[maybe_unused]] const ssize_t written = write(descriptor, &what, sizeof what);
}

[[noreturn]] void give_up(int problem) {
  report({.problem = problem});
  _exit(127);
}

/// Keeps four descriptors, under fixed numbers, and closes all others of the program's.
void take_descriptors(const SupervisedProgram& program) {
  const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
  int apart[]{program.reports, program.out, program.err, null};
  for (int& descriptor : apart) descriptor = fcntl(descriptor, F_DUPFD_CLOEXEC, 64);
  for (int n = 0; n < 4; ++n) dup3(apart[n], kReports + n, O_CLOEXEC);
  syscall(SYS_close_range, kFirstFree, ~0U, 0);
}

/// What the kernel gives a new program, whatever this one had set.
void reset_signals() {
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void become(const SupervisedProgram& program, pid_t supervisor) {
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != supervisor) _exit(127);
  reset_signals();
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const rlimit file_size{program.file_bytes, program.file_bytes};
  if (program.file_bytes > 0) setrlimit(RLIMIT_FSIZE, &file_size);
  if (chdir(program.folder) != 0) give_up(errno);
  dup2(kNull, STDIN_FILENO);
  dup2(kOut, STDOUT_FILENO);
  dup2(kErr, STDERR_FILENO);
  execv(program.file, program.arguments);
  give_up(errno);
}

/// SIGKILL for every child of this process, as the kernel lists them; false where it does not.
bool kill_children() {
  const int list = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  if (list < 0) return false;
  char part[4096];
  pid_t id = 0;
  for (ssize_t size = 0; (size = read(list, part, sizeof part)) > 0;)
    for (ssize_t n = 0; n < size; ++n) {
      if (part[n] >= '0' && part[n] <= '9') {
        id = 10 * id + (part[n] - '0');
      } else {
        if (id > 0) kill(id, SIGKILL);
        id = 0;
      }
    }
  close(list);
  return true;
}

/// Reaps the children that have ended, but for the program: true once it has. Until it is reaped,
/// no other process or group can have its id.
bool has_ended(pid_t program) {
  siginfo_t one{};
  while (waitid(P_ALL, 0, &one, WEXITED | WNOHANG | WNOWAIT) == 0 && one.si_pid > 0) {
    if (one.si_pid == program) return true;
    waitpid(one.si_pid, nullptr, 0);
    one = {};
  }
  return false;
}

/// Kills the program, which is not reaped yet, and its group; then kills and reaps until there is
/// no child any more; what loses its parent becomes one. Where the kernel lists no children, until
/// there is none of the group.
void end_all(pid_t program, int& status) {
  constexpr timespec kMoment{0, 1'000'000};
  kill(-program, SIGKILL);
  kill(program, SIGKILL);  // it may not have a group yet
  while (true) {
    const bool listed = kill_children();
    int one = 0;
    const pid_t id = waitpid(listed ? -1 : -program, &one, WNOHANG);
    if (id == program) status = one;
    if (id < 0 && errno == ECHILD) return;
    if (id == 0) nanosleep(&kMoment, nullptr);
  }
}

[[noreturn]] void supervise(const SupervisedProgram& program, pid_t parent) {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGCHLD);
  sigaddset(&awaited, SIGTERM);
  sigprocmask(SIG_BLOCK, &awaited, nullptr);
  signal(SIGCHLD, SIG_DFL);  // ignored, children would be forgotten
  signal(SIGTERM, SIG_DFL);
  setsid();
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  take_descriptors(program);
  report({.begun = getpid()});
  if (getppid() != parent) _exit(127);  // it ended before it could be told
  const pid_t self = getpid(), child = fork();
  if (child < 0) give_up(errno);
  if (child == 0) become(program, self);
  SupervisorReport outcome;
  outcome.status = SIGKILL;  // of wait: where SIGTERM comes first
  while (!has_ended(child))
    if (sigwaitinfo(&awaited, nullptr) == SIGTERM) break;
  end_all(child, outcome.status);
  getrusage(RUSAGE_CHILDREN, &outcome.usage);
  report(outcome);
  _exit(0);
}

// What is sent to the server: the head, then file, folder and arguments, each with its zero.
struct Request {
  std::uint64_t file_bytes = 0;
  std::uint32_t arguments = 0;
};
constexpr std::size_t kMostRequestBytes = 1 << 17, kMostArguments = 1 << 12;

/// A request on its way: `bytes` of it, and room for the descriptors that are sent along, to print
/// and report to.
struct Message {
  Message(char* bytes, std::size_t size) : part{bytes, size} {
    head.msg_iov = &part;
    head.msg_iovlen = 1;
    head.msg_control = room;
    head.msg_controllen = sizeof room;
  }
  Message(const Message&) = delete;
  Message& operator=(const Message&) = delete;

  iovec part;
  alignas(cmsghdr) char room[CMSG_SPACE(3 * sizeof(int))]{};
  msghdr head{};
};

/// One request; false when the other end is closed.
bool receive(int socket, char* bytes, std::size_t& size, int (&passed)[3]) {
  Message message(bytes, kMostRequestBytes);
  ssize_t received = 0;
  do received = recvmsg(socket, &message.head, MSG_CMSG_CLOEXEC);
  while (received < 0 && errno == EINTR);
  const cmsghdr* control = CMSG_FIRSTHDR(&message.head);
  if (received <= 0 || control == nullptr) return false;
  std::memcpy(passed, CMSG_DATA(control), sizeof passed);
  size = static_cast<std::size_t>(received);
  return true;
}

[[noreturn]] void serve(int socket) {
  static char bytes[kMostRequestBytes];
  static char* words[kMostArguments + 3];
  setsid();  // Ctrl-C is for the program that it serves
  signal(SIGCHLD, SIG_IGN);
  dup3(socket, kReports, O_CLOEXEC);
  syscall(SYS_close_range, kReports + 1, ~0U, 0);
  int passed[3]{};
  for (std::size_t size = 0; receive(kReports, bytes, size, passed);) {
    Request head;
    std::memcpy(&head, bytes, sizeof head);
    std::size_t count = 0;
    for (char* next = bytes + sizeof head; next < bytes + size; next += std::strlen(next) + 1)
      words[count++] = next;
    words[count] = nullptr;
    const pid_t self = getpid(), supervisor = fork();
    if (supervisor == 0)
      supervise({words[0], words + 2, words[1], head.file_bytes, passed[0], passed[1], passed[2]},
                self);
    if (supervisor < 0) report({.problem = errno}, passed[2]);
    for (const int descriptor : passed) close(descriptor);
  }
  _exit(0);
}

}  // namespace

SupervisorServer::SupervisorServer() {
  int ends[2]{-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(std::string("no socket: ") + std::strerror(errno));
  id_ = fork();
  if (id_ == 0) serve(ends[1]);
  close(ends[1]);
  socket_ = ends[0];
  if (id_ > 0) return;
  close(socket_);
  throw Error(std::string("no process: ") + std::strerror(errno));
}

SupervisorServer::~SupervisorServer() {
  close(socket_);
  while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool SupervisorServer::start(const SupervisedProgram& program) const {
  Request head{program.file_bytes};
  std::string bytes(sizeof head, '\0');
  for (const char* word : {program.file, program.folder}) bytes.append(word) += '\0';
  for (char* const* word = program.arguments; *word != nullptr; ++word, ++head.arguments)
    bytes.append(*word) += '\0';
  std::memcpy(bytes.data(), &head, sizeof head);
  if (bytes.size() > kMostRequestBytes || head.arguments > kMostArguments) {
    errno = E2BIG;
    return false;
  }
  const int passed[3]{program.out, program.err, program.reports};
  Message message(bytes.data(), bytes.size());
  cmsghdr* control = CMSG_FIRSTHDR(&message.head);
  control->cmsg_level = SOL_SOCKET;
  control->cmsg_type = SCM_RIGHTS;
  control->cmsg_len = CMSG_LEN(sizeof passed);
  std::memcpy(CMSG_DATA(control), passed, sizeof passed);
  return sendmsg(socket_, &message.head, MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

pid_t fork_supervisor(const SupervisedProgram& program) {
  const pid_t parent = getpid(), id = fork();
  if (id == 0) supervise(program, parent);
  return id;
}

}  // namespace mapscore
