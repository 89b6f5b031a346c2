/// The motion files that are written.
#pragma once

#include <import/skeleton/motion.h>
#include <motion_files/played_motion.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace mobbscope {

struct MotionFormat {
    std::string_view extension;  ///< in lower case, with its dot
    std::string (*write)(const PlayedMotion&);
    /// The bytes of one again; `file` stands for it in messages. Throws InputError.
    MotionFile (*read)(std::string_view bytes, const std::filesystem::path& file);
};

std::span<const MotionFormat> motion_formats();

/// That of a file's extension; null if motion is not written so.
const MotionFormat* motion_format(const std::filesystem::path& file);

}  // namespace mobbscope
