// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store_trouble.hpp"

#include "eval/results/store.hpp"
#include "tests/eval/results/stored_results.hpp"
#include "tests/support/expect_error.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using testing::bytes_of;
using testing::result_of;
using testing::run_sql;
using StoreTrouble = testing::StoreTest;

void put(std::string& bytes, std::size_t at, std::uint32_t number, int width) {
  for (int n = 0; n < width; ++n)
    bytes[at + n] = static_cast<char>(number >> (8 * (width - 1 - n)));
}

/// A page of the table `trials`, by SQLite's file format: 50 times the same child, or one row where
/// there is no child.
std::string table_page(std::uint32_t child) {
  constexpr std::size_t kPage = 512;
  const int cells = child > 0 ? 50 : 1;
  // Length and rowid, then a record: 'k' and three NULL; or the child (put below) and its rowid.
  const std::string cell =
      child > 0 ? std::string("\0\0\0\0\1", 5) : std::string("\6\1\5\17\0\0\0k", 8);
  std::string page(kPage - cell.size(), '\0');
  page += cell;
  const std::size_t at = page.size() - cell.size();
  page[0] = child > 0 ? 5 : 13;
  put(page, 3, static_cast<std::uint32_t>(cells), 2);
  put(page, 5, static_cast<std::uint32_t>(at), 2);
  if (child > 0) put(page, at, child, 4);
  if (child > 0) put(page, 8, child, 4);
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells); ++n)
    put(page, (child > 0 ? 12 : 8) + 2 * n, static_cast<std::uint32_t>(at), 2);
  return page;
}

/// A store of 10 kB with 50^15 rows: each of 15 pages names the next one 50 times.
void write_endless_store(const std::filesystem::path& file) {
  run_sql(file, "PRAGMA page_size = 512; VACUUM");
  ResultStore::open(file).set_text("study", "text");
  std::string bytes = bytes_of(file);
  const std::size_t pages = bytes.size() / 512;
  const std::size_t root = 4;  // schema, texts, its index, trials, its index
  bytes.replace((root - 1) * 512, 512, table_page(static_cast<std::uint32_t>(pages + 1)));
  for (std::size_t page = pages + 1; page < pages + 15; ++page)
    bytes += table_page(static_cast<std::uint32_t>(page + 1));
  bytes += table_page(0);
  put(bytes, 28, static_cast<std::uint32_t>(bytes.size() / 512), 4);
  std::ofstream(file, std::ios::binary) << bytes;
}

/// Another process that holds a lock of SQLite's on a file until the destructor.
class OtherProcess {
 public:
  explicit OtherProcess(const std::filesystem::path& file) {
    int ready[2];
    if (pipe(ready) != 0) return;
    id_ = fork();
    if (id_ == 0) {
      struct flock lock {};
      lock.l_type = F_WRLCK;
      lock.l_start = 0x40000001;
      lock.l_len = 1;
      const int descriptor = ::open(file.c_str(), O_RDWR);
      const char answer = fcntl(descriptor, F_SETLK, &lock) == 0 ? 'y' : 'n';
      if (write(ready[1], &answer, 1) == 1) pause();
      _exit(0);
    }
    char answer = 'n';
    EXPECT_EQ(read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, 'y');
    close(ready[0]);
    close(ready[1]);
  }
  ~OtherProcess() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;
  [[nodiscard]] pid_t id() const { return id_; }

 private:
  pid_t id_ = -1;
};

TEST_F(StoreTrouble, RefusesWhatIsNoStore) {
  expect_error("run `mapscore sweep` first",
               [&] { (void)ResultStore::open_existing(file("none.sqlite")); });
  std::ofstream(file("text.sqlite")) << "not a database, but long enough to have a header\n";
  expect_error("check free space, permissions and that it is a store",
               [&] { (void)ResultStore::open(file("text.sqlite")); });
  expect_error("that it is a store",
               [&] { (void)ResultStore::open_existing(file("text.sqlite")); });
}

TEST_F(StoreTrouble, RefusesAnotherFormat) {
  ResultStore::open(file("a.sqlite")).set_text("format_version", "999");
  expect_error("format 999", [&] { (void)ResultStore::open(file("a.sqlite")); });
  expect_error("another format", [&] { (void)ResultStore::open_existing(file("a.sqlite")); });
}

TEST_F(StoreTrouble, RefusesAFolderThatCanNotBe) {
  std::ofstream(file("in_the_way")) << "";
  expect_error("cannot be written",
               [&] { (void)ResultStore::open(file("in_the_way") / "a.sqlite"); });
}

TEST_F(StoreTrouble, RefusesEverySchemaButItsOwn) {
  for (const char* made :
       {"TRIGGER t AFTER INSERT ON trials BEGIN DELETE FROM trials; END", "VIEW v AS SELECT 1",
        "TABLE t (x)", "INDEX i ON trials (result)", "VIRTUAL TABLE t USING fts5(x)"}) {
    std::filesystem::remove(file("a.sqlite"));
    (void)ResultStore::open(file("a.sqlite"));
    run_sql(file("a.sqlite"), std::string("CREATE ") + made);
    const std::string what = "which mapscore does not make; sweep again into another folder";
    expect_error(what, [&] { (void)ResultStore::open(file("a.sqlite")); });
    expect_error(what, [&] { (void)ResultStore::open_existing(file("a.sqlite")); });
  }
}

TEST_F(StoreTrouble, RefusesTablesOfItsNamesThatAreOthers) {
  run_sql(file("a.sqlite"), "CREATE TABLE texts (name TEXT, value TEXT AS (upper(name)))");
  expect_error("holds the table 'texts'", [&] { (void)ResultStore::open(file("a.sqlite")); });
  std::filesystem::remove(file("a.sqlite"));
  run_sql(file("a.sqlite"),
          "CREATE VIEW texts AS WITH RECURSIVE n(name, value) AS "
          "(VALUES(1, 1) UNION ALL SELECT name + 1, 1 FROM n) SELECT * FROM n");
  expect_error("holds the view 'texts'",
               [&] { (void)ResultStore::open_existing(file("a.sqlite")); });
}

TEST_F(StoreTrouble, EndsWherePagesNameOneAnotherWithoutEnd) {
  write_endless_store(file("a.sqlite"));
  const ResultStore endless = ResultStore::open_existing(file("a.sqlite"));
  expect_error("endless steps", [&] { (void)endless.builds(); });
}

TEST_F(StoreTrouble, RefusesAJournalThatNamesAFileToDelete) {
  (void)ResultStore::open(file("a.sqlite"));
  std::ofstream(file("a.sqlite-journal"), std::ios::binary) << "path of a file"
                                                            << "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::filesystem::create_symlink(file("a.sqlite"), file("link.sqlite"));
  for (const char* name : {"a.sqlite", "link.sqlite"}) {
    expect_error("names a file to delete", [&] { (void)ResultStore::open(file(name)); });
    expect_error("names a file to delete", [&] { (void)ResultStore::open_existing(file(name)); });
  }
}

TEST_F(StoreTrouble, MergeTakesNothingThatCanNotBeRead) {
  ResultStore a = ResultStore::open(file("a.sqlite"));
  {
    ResultStore b = ResultStore::open(file("b.sqlite"));
    b.add("bad", "", result_of(1));
    b.add("good", "", result_of(2));
  }
  run_sql(file("b.sqlite"), "UPDATE trials SET result = '{}' WHERE key = 'bad'");
  const ResultStore b = ResultStore::open_existing(file("b.sqlite"));
  expect_error("b.sqlite: stored result: not readable", [&] { (void)a.merge(b); });
}

TEST_F(StoreTrouble, ARemovedFolderIsCalledRemoved) {
  const auto folder = file("results");
  ResultStore store = ResultStore::open(folder / "a.sqlite");
  std::filesystem::remove_all(folder);
  expect_error("its folder was removed or replaced while in use",
               [&] { store.add("key", "", result_of(1)); });
}

TEST_F(StoreTrouble, ALockNamesItsHolder) {
  const ResultStore store = ResultStore::open(file("a.sqlite"));
  EXPECT_EQ(lock_holder(file("a.sqlite")), "");
  EXPECT_EQ(lock_holder(file("none.sqlite")), "");
  EXPECT_NE(store_trouble(SQLITE_BUSY, "", file("a.sqlite")).find("locked by another process"),
            std::string::npos);
  const OtherProcess holder(file("a.sqlite"));
  const std::string named = lock_holder(file("a.sqlite"));
  EXPECT_NE(named.find("(process " + std::to_string(holder.id()) + ")"), std::string::npos)
      << named;
  EXPECT_NE(store_trouble(SQLITE_BUSY, "", file("a.sqlite")).find("locked by " + named),
            std::string::npos);
}

}  // namespace
}  // namespace mapscore::eval
