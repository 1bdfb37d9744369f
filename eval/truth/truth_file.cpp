// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/truth_file.hpp"

#include "core/error.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <fstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

/// The classes as they stand in the table; ids of the truth beyond it have their number as a name.
std::vector<SemanticClass> classes_of(const SurfaceTruth& truth, const ClassTable& table) {
  std::vector<SemanticClass> classes = table.classes;
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    while (voxel.class_id >= classes.size()) {
      SemanticClass unknown;
      unknown.id = static_cast<ClassId>(classes.size());
      unknown.name = std::to_string(unknown.id);
      classes.push_back(std::move(unknown));
    }
  }
  return classes;
}

/// A CSV field, quoted where it must be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::uint32_t samples_at(const VisibleTruth* visible, const SurfaceVoxel& voxel) {
  return visible == nullptr ? 0 : visible->samples(voxel.key, voxel.class_id);
}

/// A file under construction beside the one that it will replace: bytes go out in pieces, so that
/// a truth of any size takes no memory for its text. Removed unless finished.
class FileAside {
 public:
  explicit FileAside(const std::filesystem::path& file) : file_(file), aside_(file) {
    aside_ += ".partial";
    out_.open(aside_, std::ios::binary | std::ios::trunc);
  }
  ~FileAside() {
    std::error_code ignored;
    if (!finished_) std::filesystem::remove(aside_, ignored);
  }
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  /// Writes what has gathered and empties it, when there is enough of it.
  void take(std::string& bytes, std::size_t enough = 1 << 16) {
    if (bytes.size() < enough) return;
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  }

  void finish() {
    out_.close();
    std::error_code failure;
    if (out_) std::filesystem::rename(aside_, file_, failure);
    finished_ = out_ && !failure;
    if (finished_) return;
    throw Error(file_.string() +
                ": cannot be written; check that its folder exists, may be written " +
                "to and has room");
  }

 private:
  std::filesystem::path file_, aside_;
  std::ofstream out_;
  bool finished_ = false;
};

void append_number(std::string& text, std::int64_t n, char end) {
  std::array<char, 24> digits{};
  const auto last = std::to_chars(digits.data(), digits.data() + digits.size(), n).ptr;
  text.append(digits.data(), last);
  text += end;
}

void write_csv(FileAside& file, const SurfaceTruth& truth, const VisibleTruth* visible,
               const std::vector<std::string>& names) {
  std::string text = "i,j,k,class,touch_only,samples\n";
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    append_number(text, voxel.key.i, ',');
    append_number(text, voxel.key.j, ',');
    append_number(text, voxel.key.k, ',');
    text += names.at(voxel.class_id);
    text += voxel.touch_only ? ",1," : ",0,";
    append_number(text, samples_at(visible, voxel), '\n');
    file.take(text);
  }
  file.take(text, 0);
}

/// Appends the bytes of a number, lowest first.
template <typename Number>
void put(std::string& bytes, Number number) {
  using Bits =
      std::conditional_t<sizeof(Number) == 1, std::uint8_t,
                         std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint32_t>>;
  const auto bits = std::bit_cast<Bits>(number);
  for (unsigned byte = 0; byte < sizeof(Number); ++byte) {
    bytes += static_cast<char>(bits >> (8 * byte) & 0xffu);
  }
}

void write_ply(FileAside& file, const SurfaceTruth& truth, const VisibleTruth* visible,
               const std::vector<SemanticClass>& classes) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(truth.voxels().size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                      "property uchar green\nproperty uchar blue\nproperty ushort class\n"
                      "property uchar touch_only\nproperty uint samples\nend_header\n";
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    const Eigen::Vector3d centre = centre_of(voxel.key, truth.edge_m());
    const Colour& colour = classes.at(voxel.class_id).colour;
    for (const double x : centre) put(bytes, static_cast<float>(x));
    for (const std::uint8_t c : {colour.r, colour.g, colour.b}) put(bytes, c);
    put(bytes, voxel.class_id);
    put(bytes, static_cast<std::uint8_t>(voxel.touch_only));
    put(bytes, samples_at(visible, voxel));
    file.take(bytes);
  }
  file.take(bytes, 0);
}

}  // namespace

void write_truth(const std::filesystem::path& file, const SurfaceTruth& truth,
                 const VisibleTruth* visible, const ClassTable& table) {
  if (visible != nullptr && visible->edge_m() != truth.edge_m()) {
    throw Error("voxel_m: a visible truth of " + std::to_string(visible->edge_m()) +
                " m and a surface of " + std::to_string(truth.edge_m()) +
                " m do not match; compute both at one size");
  }
  const std::string ending = file.extension().string();
  if (ending != ".csv" && ending != ".ply") {
    throw Error(file.string() +
                ": truth is written as .csv or .ply; give the file one of these endings");
  }
  const std::vector<SemanticClass> classes = classes_of(truth, table);
  FileAside aside(file);
  if (ending == ".csv") {
    std::vector<std::string> names;
    for (const SemanticClass& c : classes) names.push_back(field(c.name));
    write_csv(aside, truth, visible, names);
  } else {
    write_ply(aside, truth, visible, classes);
  }
  aside.finish();
}

}  // namespace mapscore::eval
