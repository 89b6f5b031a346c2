/// Each reader with what the program does next with what it read; see Target::read.
#pragma once

#include <import/import.h>

#include <string>

namespace mobbscope::fuzz {

void read_fbx(const std::string& bytes);
void read_gltf(const std::string& bytes);
void read_bvh(const std::string& bytes);
/// As a file of that reader, which is one of tracks.
void read_tracks(const FileReader& reader, const std::string& bytes);
void read_radius_table(const std::string& bytes);
void read_any_file(const std::string& bytes);  ///< told by its content, and packed by gzip
void read_scene(const std::string& bytes);
void read_certificate_file(const std::string& bytes);
void read_case(const std::string& bytes);
void read_golden(const std::string& bytes);  ///< of answers, a trace or a fit
void read_script(const std::string& bytes);
void read_view_state(const std::string& bytes);
void read_settings(const std::string& bytes);
void read_png_file(const std::string& bytes);
void read_state(const std::string& bytes);  ///< of a picture
void read_result_line(const std::string& bytes);
void read_request_line(const std::string& bytes);
void read_report(const std::string& bytes);

}  // namespace mobbscope::fuzz
