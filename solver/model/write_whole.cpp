// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/write_whole.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

namespace fs = std::filesystem;

void sync_path(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), flags);
  if (file < 0) throw Error("write", "cannot reopen " + path.string() + " to sync it", std::strerror(errno));
  const int failed = ::fsync(file);
  const int reason = errno;
  ::close(file);
  // Some file systems have no fsync for folders and say EINVAL; that loses nothing.
  if (failed != 0 && reason != EINVAL)
    throw Error("write", "cannot sync " + path.string() + " to disk", std::strerror(reason));
}

}  // namespace

void write_whole(const fs::path& path, const std::function<void(const fs::path&)>& write, bool keep_extension) {
  std::error_code failure;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  fs::create_directories(folder, failure);
  if (failure) throw Error("write", "cannot create the folder " + folder.string(), failure.message());

  fs::path temporary = path;
  if (keep_extension)
    temporary.replace_extension(".tmp" + path.extension().string());
  else
    temporary += ".tmp";
  try {
    write(temporary);
    sync_path(temporary, O_RDONLY);
    fs::rename(temporary, path, failure);
    if (failure) throw Error("write", "cannot rename " + temporary.string(), failure.message());
  } catch (...) {
    fs::remove(temporary, failure);
    throw;
  }
  sync_path(folder, O_RDONLY | O_DIRECTORY);
}

void write_whole(const fs::path& path, std::string_view bytes) {
  write_whole(path, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw Error("write", "cannot write " + temporary.string(), std::strerror(errno));
  });
}

}  // namespace scarp
