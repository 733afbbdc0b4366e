// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_laz.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "ingest/read_las.hpp"
#include "solver/model/error.hpp"

extern char** environ;  // handed on to the child as it is

namespace scarp {
namespace {

namespace fs = std::filesystem;

constexpr int kPackageMissing = 3;            // exit code of laz2las.mjs
constexpr std::size_t kMostText = 64 * 1024;  // of the child's standard error

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::string& value = {}) {
  throw Error("ingest", what, value, {}, {path.string()});
}

/// A folder for one conversion, removed with the object.
class ScratchFolder {
 public:
  ScratchFolder(const fs::path& parent, const fs::path& input) {
    std::string name = (parent / "scarp-laz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      fail(input, "cannot create a temporary folder in " + parent.string() + " to decompress into",
           std::strerror(errno));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// A child process; killed with the object unless it was waited for.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The status as waitpid gives it.
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
};

std::string install_command(const LazConverter& converter) {
  return "npm ci --prefix " + converter.script.parent_path().string();
}

/// Starts `node SCRIPT INPUT OUTPUT` with nothing to read, nothing shown, and its errors into `errors`.
pid_t start(const LazConverter& converter, const fs::path& input, const fs::path& output, int errors) {
  std::array<std::string, 4> words{"node", converter.script.string(), fs::absolute(input).string(), output.string()};
  std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, errors, 2);
  ::posix_spawn_file_actions_addclosefrom_np(&actions, 3);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, "node", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT)
    fail(input, "LAZ needs Node.js 18 or newer, and no program \"node\" was found: install it, then run " +
                    install_command(converter) + "; or convert the file to LAS");
  if (failed != 0) fail(input, "the LAZ converter (node) cannot be started", std::strerror(failed));
  return child;
}

/// All of it is read, so that the child never waits for us; the end is kept.
std::string drain(int from) {
  std::string text;
  std::array<char, 4096> part;
  for (;;) {
    const ssize_t got = ::read(from, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(got));
    if (text.size() > kMostText) text.erase(0, text.size() - kMostText / 2);
  }
  return text;
}

/// The converter's own line, or else the end of what there is, printable and on one line.
std::string reason_in(const std::string& errors) {
  constexpr std::string_view prefix = "laz2las: ";
  std::string reason = errors.size() > 400 ? errors.substr(errors.size() - 400) : errors;
  if (const std::size_t at = errors.rfind(prefix); at != std::string::npos) {
    const std::size_t begin = at + prefix.size();
    reason = errors.substr(begin, std::min<std::size_t>(400, errors.find('\n', begin) - begin));
  }
  for (char& c : reason)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  while (!reason.empty() && reason.back() == ' ') reason.pop_back();
  return reason;
}

void convert(const LazConverter& converter, const fs::path& input, const fs::path& output) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail(input, "cannot open a pipe", std::strerror(errno));
  Descriptor reading(ends[0]), writing(ends[1]);
  Child child(start(converter, input, output, writing.get()));
  writing.close();
  const std::string errors = drain(reading.get());
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFSIGNALED(status))
    fail(input, "the LAZ converter was stopped by signal " + std::to_string(WTERMSIG(status)) +
                    " (9 often means: out of memory)");
  if (WEXITSTATUS(status) == kPackageMissing)
    fail(input,
         "LAZ needs the npm package laz-perf: run " + install_command(converter) + "; or convert the file to LAS");
  const std::string reason = reason_in(errors);
  fail(input, "cannot be decompressed: " +
                  (reason.empty() ? "the converter ended with code " + std::to_string(WEXITSTATUS(status)) : reason));
}

/// A damaged count must not fill the disk.
void check_room(const LasHeader& header, const fs::path& input, const fs::path& scratch) {
  std::error_code failure;
  const fs::space_info space = fs::space(scratch, failure);
  if (failure) fail(input, "cannot ask for the free space in " + scratch.string(), failure.message());
  if (header.count > space.available / header.record_length)
    fail(input, "no room to decompress: the header promises " + std::to_string(header.count) + " points of " +
                    std::to_string(header.record_length) + " bytes, " + scratch.string() + " has " +
                    std::to_string(space.available) + " bytes free");
}

}  // namespace

LazConverter default_laz_converter() {
  LazConverter converter;
  converter.script = SCARP_LAZ2LAS_SCRIPT;
  std::error_code failure;
  if (fs::exists(converter.script, failure)) return converter;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  const fs::path installed =
      (program.parent_path() / ".." / "share" / "scarp" / "laz2las" / "laz2las.mjs").lexically_normal();
  if (!failure && fs::exists(installed, failure)) converter.script = installed;
  return converter;
}

PointCloud read_laz(const fs::path& path, const LazConverter& converter) {
  const LasHeader header = read_las_header(path);
  if (!header.compressed) return read_las(path);
  std::error_code failure;
  if (!fs::exists(converter.script, failure))
    fail(path, "LAZ needs the converter " + converter.script.string() + ", which does not exist");
  const ScratchFolder folder(converter.scratch, path);
  check_room(header, path, folder.path());
  const fs::path plain = folder.path() / "points.las";
  convert(converter, path, plain);
  PointCloud cloud = read_las(plain, path.string());
  if (cloud.size() != header.count)
    fail(path, "the LAZ converter gave " + std::to_string(cloud.size()) + " points, the header promises " +
                   std::to_string(header.count));
  return cloud;
}

}  // namespace scarp
