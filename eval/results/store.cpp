// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"

#include "core/error.hpp"
#include "eval/results/store_trouble.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"
#include "files/zlib_text.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <sstream>
#include <system_error>

namespace mapscore::eval {
namespace {

constexpr int kStoreFormat = 1;

constexpr const char* kTexts = "texts (name TEXT PRIMARY KEY, value TEXT NOT NULL)";
constexpr const char* kBuild = "build TEXT NOT NULL DEFAULT ''";
constexpr const char* kTrialsWithoutBuild =
    "trials (key TEXT PRIMARY KEY, description TEXT NOT NULL, result TEXT NOT NULL)";
/// What SQLite makes of the table above when kBuild is added to it.
constexpr const char* kTrials =
    "trials (key TEXT PRIMARY KEY, description TEXT NOT NULL, result TEXT NOT NULL, "
    "build TEXT NOT NULL DEFAULT '')";
constexpr const char* kFailed = "failed ";  ///< and the key: name of the text that says why
constexpr const char* kCost = "cost ";      ///< and the key: exit code, two times, bytes
/// The fifth parameter is the build whose trials replace those of others.
constexpr const char* kAddTrial =
    "INSERT INTO trials VALUES (?1, ?2, CAST(?3 AS BLOB), ?4) ON CONFLICT (key) DO UPDATE SET "
    "description = excluded.description, result = excluded.result, build = excluded.build "
    "WHERE excluded.build = ?5 AND trials.build <> ?5";

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw Error(file.string() + ": " + reason);
}

/// One prepared statement with the texts of its parameters; columns count from 0. A database
/// has one at a time. It ends in an Error after many more steps than its file can ask for: pages
/// that name one another have no end.
class Statement {
 public:
  Statement(sqlite3* database, const std::filesystem::path& file, const std::string& sql,
            const std::vector<std::string>& texts = {})
      : database_(database), file_(file) {
    std::error_code no_file;
    const std::uintmax_t bytes = std::filesystem::file_size(file, no_file);
    rests_left_ += no_file ? 0 : static_cast<std::int64_t>(bytes) / kRestEvery * kStepsAByte;
    sqlite3_progress_handler(
        database, kRestEvery,
        [](void* self) { return --static_cast<Statement*>(self)->rests_left_ < 0 ? 1 : 0; }, this);
    if (sqlite3_prepare_v2(database, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) refuse();
    for (int parameter = 1; const std::string& text : texts)
      sqlite3_bind_text(statement_, parameter++, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT);
  }
  ~Statement() { close(); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// True while there is a row.
  [[nodiscard]] bool step() {
    const int outcome = sqlite3_step(statement_);
    if (outcome != SQLITE_ROW && outcome != SQLITE_DONE) refuse();
    return outcome == SQLITE_ROW;
  }
  [[nodiscard]] std::string text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return bytes ? std::string(bytes,
                               static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)))
                 : std::string();
  }

 private:
  void close() {
    sqlite3_finalize(std::exchange(statement_, nullptr));
    sqlite3_progress_handler(database_, 0, nullptr, nullptr);
  }
  [[noreturn]] void refuse() {
    const std::string reason =
        store_trouble(sqlite3_extended_errcode(database_), sqlite3_errmsg(database_), file_);
    close();
    fail(file_, reason);
  }

  static constexpr int kRestEvery = 10'000;  ///< steps of SQLite's virtual machine
  static constexpr int kStepsAByte = 20;     ///< a row takes ten bytes and steps, or more bytes
  std::int64_t rests_left_ = 1000;

  sqlite3* database_;
  const std::filesystem::path& file_;
  sqlite3_stmt* statement_ = nullptr;
};

/// A result as it stands in a row.
std::string packed(const TrialResult& result) {
  constexpr int kLevel = 6;
  return zlib_packed(to_json(result), kLevel);
}

/// The result of one row, whose file an Error names. Older rows hold plain JSON.
TrialResult result_of(const std::string& bytes, const std::filesystem::path& file) try {
  constexpr std::size_t kMostBytes = std::size_t{1} << 26;
  return result_from_json(bytes.starts_with('{') ? bytes : zlib_unpacked(bytes, kMostBytes));
} catch (const Error& error) {
  fail(file, error.what());
}

}  // namespace

Accounting& Accounting::operator+=(const Accounting& other) {
  add_counts(*this, other);
  const auto add = []<class Part>(std::optional<Part>& sum, const std::optional<Part>& part) {
    if (part) add_counts(sum ? *sum : sum.emplace(), *part);
  };
  add(tracking, other.tracking);
  add(calibration, other.calibration);
  return *this;
}

void ResultStore::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

ResultStore::ResultStore(const std::filesystem::path& file, int flags, const char* refusal)
    : file_(file) {
  refuse_super_journal(file);
  sqlite3* raw = nullptr;
  const int outcome = sqlite3_open_v2(file.c_str(), &raw, flags, nullptr);
  database_.reset(raw);
  if (outcome != SQLITE_OK) fail(file, refusal);
  sqlite3_busy_timeout(database_.get(), 10000);
  // What a stranger's store could do: functions with side effects in its schema, triggers, views,
  // pages that SQLite takes for its own.
  for (const int off : {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                        SQLITE_DBCONFIG_ENABLE_VIEW})
    sqlite3_db_config(database_.get(), off, 0, nullptr);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(database_.get(), SQLITE_LIMIT_ATTACHED, 0);
  refuse_foreign_schema();
}

void ResultStore::refuse_foreign_schema() {
  Statement query(database_.get(), file_, "SELECT type, name, sql FROM sqlite_schema");
  while (query.step()) {
    constexpr std::size_t kShown = 40;
    const std::string name = query.text(1), sql = query.text(2);
    const bool is_index =
        sql.empty() && (name == "sqlite_autoindex_texts_1" || name == "sqlite_autoindex_trials_1");
    if (!is_index && sql != std::string("CREATE TABLE ") + kTexts &&
        sql != std::string("CREATE TABLE ") + kTrials &&
        sql != std::string("CREATE TABLE ") + kTrialsWithoutBuild)
      fail(file_,
           fmt::format("result store: holds the {} '{}', which mapscore does not make; "
                       "sweep again into another folder",
                       shown(query.text(0).substr(0, kShown)), shown(name.substr(0, kShown))));
    if (sql == std::string("CREATE TABLE ") + kTrialsWithoutBuild) tells_builds_ = false;
  }
}

void ResultStore::tell_builds() {
  execute("BEGIN IMMEDIATE");  // then another process has added the column already, or waits
  tells_builds_ = true;
  refuse_foreign_schema();
  if (!tells_builds_) execute(std::string("ALTER TABLE trials ADD COLUMN ") + kBuild);
  execute("COMMIT");
  tells_builds_ = true;
}

ResultStore ResultStore::open(const std::filesystem::path& file, std::string_view build) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  ResultStore store(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,
                    "cannot be written; check the folder and its permissions");
  store.execute(std::string("CREATE TABLE IF NOT EXISTS ") + kTexts);
  store.execute(std::string("CREATE TABLE IF NOT EXISTS ") + kTrials);
  store.build_ = build;
  if (!store.tells_builds_) store.tell_builds();
  const std::string format = store.text("format_version");
  if (format.empty())
    store.set_text("format_version", std::to_string(kStoreFormat));
  else if (format != std::to_string(kStoreFormat))
    fail(file, "result store of format " + format + ", this mapscore reads " +
                   std::to_string(kStoreFormat) + "; sweep again into another folder");
  return store;
}

ResultStore ResultStore::open_existing(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    fail(file, "no result store there; " + path_suggestion(file, "run `mapscore sweep` first"));
  // Read-write, so that SQLite can roll back what a killed sweep left half-written; a store on a
  // read-only disk is opened for reading all the same.
  ResultStore store(file, SQLITE_OPEN_READWRITE, "cannot be opened; check its permissions");
  if (store.text("format_version") != std::to_string(kStoreFormat))
    fail(file, "result store of another format; sweep again into another folder");
  return store;
}

void ResultStore::execute(const std::string& sql, const std::vector<std::string>& texts) {
  Statement statement(database_.get(), file_, sql, texts);
  while (statement.step()) {
  }
}

void ResultStore::set_text(const std::string& name, const std::string& value) {
  if (text(name) == value) return;
  execute("INSERT OR REPLACE INTO texts VALUES (?, ?)", {name, value});
}

void ResultStore::set_texts(const std::vector<std::pair<std::string, std::string>>& texts) {
  execute("BEGIN IMMEDIATE");
  for (const auto& [name, value] : texts) set_text(name, value);
  execute("COMMIT");
}

std::string ResultStore::text(const std::string& name) const {
  Statement query(database_.get(), file_, "SELECT value FROM texts WHERE name = ?", {name});
  return query.step() ? query.text(0) : std::string();
}

std::unordered_set<std::string> ResultStore::keys(std::optional<std::string_view> build) const {
  std::unordered_set<std::string> keys;
  for (auto& [key, of_build] : builds())
    if (!build || of_build == *build) keys.insert(key);
  return keys;
}

std::unordered_map<std::string, std::string> ResultStore::builds() const {
  Statement query(database_.get(), file_,
                  tells_builds_ ? "SELECT key, build FROM trials" : "SELECT key, '' FROM trials");
  std::unordered_map<std::string, std::string> builds;
  while (query.step()) builds.emplace(query.text(0), query.text(1));
  return builds;
}

void ResultStore::add_row(std::vector<std::string> row) {
  row.push_back(build_);
  execute(kAddTrial, row);
}

void ResultStore::add(const std::string& key, const std::string& description,
                      const TrialResult& result) {
  add_row({key, description, packed(result), build_});
  execute("DELETE FROM texts WHERE name = ?", {kFailed + key});
}

void ResultStore::add_failure(const std::string& key, const std::string& reason) {
  set_text(kFailed + key, reason);
}

std::map<std::string, std::string> ResultStore::failures() const {
  return texts_after(kFailed);
}

void ResultStore::add_cost(const std::string& key, const TrialCost& cost) {
  set_text(kCost + key, fmt::format("{} {} {} {}", cost.exit_code, cost.wall_s, cost.processor_s,
                                    cost.peak_bytes));
}

std::map<std::string, TrialCost> ResultStore::costs() const {
  std::map<std::string, TrialCost> costs;
  for (const auto& [key, text] : texts_after(kCost)) {
    std::istringstream words(text);
    TrialCost cost;
    if (!(words >> cost.exit_code >> cost.wall_s >> cost.processor_s >> cost.peak_bytes))
      fail(file_,
           fmt::format("result store: the cost of trial {} is not readable; sweep again into "
                       "another folder",
                       shown(key)));
    costs[key] = cost;
  }
  return costs;
}

std::map<std::string, std::string> ResultStore::texts_after(const std::string& prefix) const {
  Statement query(database_.get(), file_, "SELECT name, value FROM texts WHERE name LIKE ?",
                  {prefix + '%'});
  std::map<std::string, std::string> texts;
  while (query.step()) texts[query.text(0).substr(prefix.size())] = query.text(1);
  return texts;
}

std::optional<TrialResult> ResultStore::find(const std::string& key) const {
  Statement query(database_.get(), file_, "SELECT result FROM trials WHERE key = ?", {key});
  if (!query.step()) return std::nullopt;
  return result_of(query.text(0), file_);
}

int ResultStore::merge(const ResultStore& other) {
  Statement query(other.database_.get(), other.file_,
                  fmt::format("SELECT key, description, result, {} FROM trials ORDER BY key",
                              other.tells_builds_ ? "build" : "''"));
  const int before = sqlite3_total_changes(database_.get());
  execute("BEGIN");
  try {
    while (query.step()) {
      (void)result_of(query.text(2), other.file_);  // so that none comes in which cannot be read
      add_row({query.text(0), query.text(1), query.text(2), query.text(3)});
    }
    execute("COMMIT");
  } catch (...) {
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
  return sqlite3_total_changes(database_.get()) - before;
}

std::filesystem::path store_file(const std::filesystem::path& results) {
  return std::filesystem::is_directory(results) ? results / "results.sqlite" : results;
}

}  // namespace mapscore::eval
