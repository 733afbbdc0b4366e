// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/model/image.hpp"

namespace scarp {

/// Writes a PNG (8-bit RGB) as a whole file.
/// @throws Error ("render") if the picture is empty or cannot be encoded; Error ("write") if the disk refuses.
void write_png(const std::filesystem::path& path, const Picture& picture);

/// Reads a PNG that write_png wrote.
/// @throws Error ("render") if the file is absent or no picture.
Picture read_png(const std::filesystem::path& path);

/// What became of a video.
struct VideoReport {
  std::filesystem::path file;       ///< empty: no video could be made, the pictures are all there is
  std::string codec;                ///< "H.264", "VP8", or "PNG sequence only"
  std::string reason_for_fallback;  ///< why not the first choice; empty if it worked
};

/// A way to store a video: a four-character code and the container that goes with it.
struct VideoFormat {
  std::string code, extension, codec;
};

/// In this order: what every browser and office program plays, then what any FFmpeg can write.
std::vector<VideoFormat> video_formats();

/// Makes STEM.mp4 of PNG files of one size, in their order, each shown for 1 / frames_per_second; if that fails,
/// STEM.webm; if that fails, says so in the report. A file counts as made once it has been reopened, has all frames in
/// the size of the pictures (made even by repeating the last column or row) and its first frame decodes; only then it
/// gets its name. At fewer than ten pictures a second each is stored several times, since players stumble otherwise.
/// @throws Error ("render") if there are no pictures, one cannot be read, or their sizes differ.
VideoReport write_video(const std::filesystem::path& stem, const std::vector<std::filesystem::path>& pictures,
                        double frames_per_second, const std::vector<VideoFormat>& formats = video_formats());

}  // namespace scarp
