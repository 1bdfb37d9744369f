// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// What to tell of a call to SQLite on the store `file` that failed: `code` is SQLite's extended
/// result code, `words` are its own words for it. A lock names the process that holds it, and a
/// store or folder that is gone is called removed, where SQLite speaks of I/O errors.
[[nodiscard]] std::string store_trouble(int code, const std::string& words,
                                        const std::filesystem::path& file);

/// "NAME (process ID)" of another process that holds one of SQLite's locks on the file; empty where
/// none does or the system does not say. This process must have the file open.
[[nodiscard]] std::string lock_holder(const std::filesystem::path& file);

/// Throws Error where the store's rollback journal names a super-journal, as only transactions over
/// several databases have: SQLite would delete the file of that name, whatever it is.
void refuse_super_journal(const std::filesystem::path& file);

}  // namespace mapscore::eval
