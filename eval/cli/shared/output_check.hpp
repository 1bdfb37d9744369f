// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "files/folder_lock.hpp"

#include <filesystem>
#include <list>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A file that a flag names, to be written when the work is done.
struct OutputFile {
  std::string flag;
  std::filesystem::path file;  ///< empty: not asked for
  std::string ending;          ///< that it must have, as ".ot"; empty: any
};

/// Refuses before the work what could not be written after it: throws Error unless each file has
/// its ending, lies in a folder that is there and is no folder itself, and no two are the same.
void check_outputs(const std::vector<OutputFile>& outputs);

/// Locks the folders of files that belong together until it is destroyed, so that two runs into one
/// place leave the files of one of them and never a mixture; waits for a run that holds one. Empty
/// names and folders that are not there are left out. Folders are locked in the order of their
/// paths, so that no two runs wait for each other.
class OutputLocks {
 public:
  explicit OutputLocks(const std::vector<std::filesystem::path>& files);

 private:
  std::list<FolderLock> locks_;
};

}  // namespace mapscore::eval
