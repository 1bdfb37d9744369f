// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"

#include "core/error.hpp"
#include "eval/results/store_trouble.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <map>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using ::testing::Key;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A result in which no two numbers are equal.
TrialResult result_of(std::int64_t number) {
  const auto next = [&] { return number++; };
  TrialResult result;
  result.counts = zero_counts(2, {});
  for (ClassCounts& c : result.counts) {
    for (auto* count : {&c.predicted, &c.true_predicted, &c.visible, &c.found, &c.false_near,
                        &c.false_leak, &c.false_floating, &c.missed_mislabelled,
                        &c.missed_unlabelled, &c.missed_unmapped, &c.visible_4, &c.found_4})
      *count = next();
    c.at_tolerance = {{1, next(), next()}};
    c.accuracy = DistanceTally({0.01, 0.02});
    c.accuracy.add(0.001 * static_cast<double>(next()));
    c.curve = {next(), next(), {{900, next(), next(), next(), next()}, {7, next(), 0, 0, next()}}};
    c.boxes = {next(), next(), next(), next(), next(), next()};
  }
  Accounting& a = result.accounting;
  for (auto* count : {&a.frames, &a.detections, &a.skipped_no_points, &a.skipped_no_seed_point,
                      &a.skipped_seed_off_object, &a.skipped_eroded_away, &a.points, &a.map_voxels,
                      &a.hits_beyond_span})
    *count = next();
  return result;
}

void run_sql(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sql;
  sqlite3_close(database);
}

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

class Store : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const char* name) const { return folder_.path() / name; }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

TEST_F(Store, GivesBackWhatWasAdded) {
  const TrialResult result = result_of(10);
  {
    ResultStore store = ResultStore::open(file("a.sqlite"));
    store.add("key", "description", result);
    store.set_text("study", "it's a study\n");
  }
  const ResultStore store = ResultStore::open_existing(file("a.sqlite"));
  const auto found = store.find("key");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->counts, result.counts);
  EXPECT_EQ(found->accounting, result.accounting);
  EXPECT_EQ(store.text("study"), "it's a study\n");
  EXPECT_EQ(store.text("nothing"), "");
  EXPECT_TRUE(store.builds().contains("key"));
  EXPECT_FALSE(store.builds().contains("other"));
  EXPECT_FALSE(store.find("other"));
}

TEST_F(Store, GivesBackInstancesWhereTheyWereScored) {
  TrialResult result = result_of(10);
  for (ClassCounts& c : result.counts) {
    c.instances = InstanceCounts{1, 2, 3, 4, 5, {{900, 6, {}}, {20, 7, {}}}};
    for (InstanceStep& step : c.instances->steps)
      for (std::size_t t = 0; t < step.true_predicted.size(); ++t)
        step.true_predicted[t] = step.score + static_cast<std::int64_t>(t);
  }
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("with", "", result);
  store.add("without", "", result_of(10));
  EXPECT_EQ(store.find("with")->counts, result.counts);
  EXPECT_EQ(store.find("without")->counts, result_of(10).counts);
}

/// As it was written before results were packed: every count, a list for each step.
TEST_F(Store, ReadsRowsOfPlainJsonFromBefore) {
  const char* text =
      R"({"accounting":{"detections":2,"frames":1,"hits_beyond_span":0,"map_voxels":8,"points":7,)"
      R"("skipped_eroded_away":0,"skipped_no_points":0,"skipped_no_seed_point":0,)"
      R"("skipped_seed_off_object":0},"classes":[{"accuracy":{"bins":[3,0,0,1],"count":5,)"
      R"("limits_m":[0.01],"sum_nm":2000000,"unreached":1,"within":[4]},"at_tolerance":[[1,5,6]],)"
      R"("boxes":{"at_25":0,"at_50":0,"at_75":0,"boxes":1,"boxes_unseen":0,"iou_sum_billionth":0},)"
      R"("completeness":{"bins":[],"count":0,"limits_m":[],"sum_nm":0,"unreached":0,"within":[]},)"
      R"("curve":{"squared_error_billionth":9,"steps":[[900,4,3,2,1],[7,1,0,0,0]],"visible":11},)"
      R"("false_floating":0,"false_leak":0,"false_near":0,"found":3,"found_4":0,)"
      R"("missed_mislabelled":0,"missed_unlabelled":0,"missed_unmapped":0,"predicted":5,)"
      R"("true_predicted":4,"visible":11,"visible_4":0}]})";
  TrialResult expected;
  expected.accounting.frames = 1;
  expected.accounting.detections = 2;
  expected.accounting.points = 7;
  expected.accounting.map_voxels = 8;
  ClassCounts& c = expected.counts.emplace_back();
  c.predicted = 5, c.true_predicted = 4, c.visible = 11, c.found = 3;
  c.at_tolerance = {{1, 5, 6}};
  c.accuracy = DistanceTally(DistanceTally::Parts{{0.01}, {4}, 5, 1, 2000000, {3, 0, 0, 1}});
  c.curve = {11, 9, {{900, 4, 3, 2, 1}, {7, 1, 0, 0, 0}}};
  c.boxes.detections = 1;
  ResultStore::open(file("a.sqlite")).set_text("study", "");
  run_sql(
      file("a.sqlite"),
      fmt::format("INSERT INTO trials (key, description, result) VALUES ('key', '', '{}')", text));
  ResultStore store = ResultStore::open(file("a.sqlite"));
  EXPECT_EQ(store.find("key")->counts, expected.counts);
  EXPECT_EQ(store.find("key")->accounting, expected.accounting);
  ResultStore other = ResultStore::open(file("b.sqlite"));
  EXPECT_EQ(other.merge(store), 1);
  EXPECT_EQ(other.find("key")->counts, expected.counts);
}

TEST_F(Store, RefusesResultsThatAreNoStream) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("key", "", result_of(10));
  for (const char* damage : {"x''", "x'789c'", "x'00'", "substr(result, 1, length(result) - 9)"}) {
    run_sql(file("a.sqlite"), std::string("UPDATE trials SET result = ") + damage);
    expect_error("a.sqlite: ", [&] { (void)store.find("key"); });
  }
}

TEST_F(Store, KeepsFailuresUntilTheTrialIsAdded) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add_failure("one", "first");
  store.add_failure("one", "second");
  store.add_failure("two", "other");
  using Failures = std::map<std::string, std::string>;
  EXPECT_EQ(store.failures(), (Failures{{"one", "second"}, {"two", "other"}}));
  store.add("one", "", result_of(1));
  EXPECT_EQ(store.failures(), (Failures{{"two", "other"}}));
}

TEST_F(Store, ATrialOfManyClassesThatHoldNothingIsSmall) {
  TrialResult result = result_of(10);
  for (int n = 0; n < 40; ++n) result.counts.push_back(zero_counts(1, {}).front());
  const std::string text = to_json(result);
  EXPECT_EQ(result_from_json(text).counts, result.counts);
  EXPECT_LT(text.size(), to_json(result_of(10)).size() + 2000);
}

TEST_F(Store, KeepsTheFirstResultOfAKey) {
  ResultStore store = ResultStore::open(file("a.sqlite"));
  store.add("key", "first", result_of(1));
  store.add("key", "second", result_of(2));
  EXPECT_EQ(store.find("key")->counts, result_of(1).counts);
}

TEST_F(Store, ReplacesTheResultOfAnotherBuild) {
  ResultStore::open(file("a.sqlite"), "before").add("key", "first", result_of(1));
  ResultStore store = ResultStore::open(file("a.sqlite"), "after");
  EXPECT_THAT(store.builds(), UnorderedElementsAre(Pair("key", "before")));
  store.add("key", "second", result_of(2));
  EXPECT_EQ(store.find("key")->counts, result_of(2).counts);
  EXPECT_THAT(store.builds(), UnorderedElementsAre(Pair("key", "after")));
}

/// A store as mapscore wrote it before trials told their build.
void write_store_without_builds(const std::filesystem::path& file, const TrialResult& result) {
  run_sql(file,
          "CREATE TABLE texts (name TEXT PRIMARY KEY, value TEXT NOT NULL);"
          "CREATE TABLE trials (key TEXT PRIMARY KEY, description TEXT NOT NULL, "
          "result TEXT NOT NULL);"
          "INSERT INTO texts VALUES ('format_version', '1');"
          "INSERT INTO trials VALUES ('old', '', '" +
              to_json(result) + "')");
}

TEST_F(Store, TrialsWithoutABuildAreOfAnother) {
  write_store_without_builds(file("a.sqlite"), result_of(1));
  {
    const std::string before = bytes_of(file("a.sqlite"));
    const ResultStore read = ResultStore::open_existing(file("a.sqlite"));
    EXPECT_EQ(read.find("old")->counts, result_of(1).counts);
    EXPECT_THAT(read.builds(), UnorderedElementsAre(Pair("old", "")));
    EXPECT_TRUE(bytes_of(file("a.sqlite")) == before);

    ResultStore other = ResultStore::open(file("b.sqlite"), "now");
    EXPECT_EQ(other.merge(read), 1);
    EXPECT_THAT(other.builds(), UnorderedElementsAre(Pair("old", "")));
  }
  ResultStore store = ResultStore::open(file("a.sqlite"), "now");
  store.add("new", "", result_of(2));
  EXPECT_THAT(store.builds(), UnorderedElementsAre(Pair("old", ""), Pair("new", "now")));
  store.add("old", "", result_of(3));
  const ResultStore again = ResultStore::open_existing(file("a.sqlite"));
  EXPECT_EQ(again.find("old")->counts, result_of(3).counts);
  EXPECT_THAT(again.builds(), UnorderedElementsAre(Pair("old", "now"), Pair("new", "now")));
}

TEST_F(Store, OpenedAgainWithTheSameTextsKeepsItsBytes) {
  {
    ResultStore store = ResultStore::open(file("a.sqlite"));
    store.add("key", "description", result_of(1));
    store.set_text("study", "text");
  }
  const std::string before = bytes_of(file("a.sqlite"));
  {
    ResultStore store = ResultStore::open(file("a.sqlite"));
    store.set_text("study", "text");
  }
  EXPECT_TRUE(bytes_of(file("a.sqlite")) == before);
}

TEST_F(Store, MergeTakesWhatIsNotThere) {
  ResultStore a = ResultStore::open(file("a.sqlite"));
  ResultStore b = ResultStore::open(file("b.sqlite"));
  a.add("one", "", result_of(1));
  b.add("one", "", result_of(100));
  b.add("two", "", result_of(2));
  EXPECT_EQ(a.merge(b), 1);
  EXPECT_THAT(a.builds(), UnorderedElementsAre(Key("one"), Key("two")));
  EXPECT_EQ(a.find("one")->counts, result_of(1).counts);
  EXPECT_EQ(a.find("two")->counts, result_of(2).counts);
  EXPECT_EQ(a.merge(b), 0);
}

TEST_F(Store, MergeTakesOfThisBuildWhatAnotherMade) {
  ResultStore a = ResultStore::open(file("a.sqlite"), "before");
  ResultStore b = ResultStore::open(file("b.sqlite"), "after");
  a.add("one", "", result_of(1));
  b.add("one", "", result_of(100));
  EXPECT_EQ(b.merge(a), 0);
  EXPECT_EQ(b.find("one")->counts, result_of(100).counts);
  EXPECT_EQ(ResultStore::open(file("a.sqlite"), "after").merge(b), 1);
  EXPECT_EQ(a.find("one")->counts, result_of(100).counts);
}

TEST_F(Store, RefusesWhatIsNoStore) {
  expect_error("run `mapscore sweep` first",
               [&] { (void)ResultStore::open_existing(file("none.sqlite")); });
  std::ofstream(file("text.sqlite")) << "not a database, but long enough to have a header\n";
  expect_error("check free space, permissions and that it is a store",
               [&] { (void)ResultStore::open(file("text.sqlite")); });
  expect_error("that it is a store",
               [&] { (void)ResultStore::open_existing(file("text.sqlite")); });
}

TEST_F(Store, RefusesAnotherFormat) {
  ResultStore::open(file("a.sqlite")).set_text("format_version", "999");
  expect_error("format 999", [&] { (void)ResultStore::open(file("a.sqlite")); });
  expect_error("another format", [&] { (void)ResultStore::open_existing(file("a.sqlite")); });
}

TEST_F(Store, RefusesAFolderThatCanNotBe) {
  std::ofstream(file("in_the_way")) << "";
  expect_error("cannot be written",
               [&] { (void)ResultStore::open(file("in_the_way") / "a.sqlite"); });
}

TEST_F(Store, RefusesEverySchemaButItsOwn) {
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

TEST_F(Store, RefusesTablesOfItsNamesThatAreOthers) {
  run_sql(file("a.sqlite"), "CREATE TABLE texts (name TEXT, value TEXT AS (upper(name)))");
  expect_error("holds the table 'texts'", [&] { (void)ResultStore::open(file("a.sqlite")); });
  std::filesystem::remove(file("a.sqlite"));
  run_sql(file("a.sqlite"),
          "CREATE VIEW texts AS WITH RECURSIVE n(name, value) AS "
          "(VALUES(1, 1) UNION ALL SELECT name + 1, 1 FROM n) SELECT * FROM n");
  expect_error("holds the view 'texts'",
               [&] { (void)ResultStore::open_existing(file("a.sqlite")); });
}

TEST_F(Store, EndsWherePagesNameOneAnotherWithoutEnd) {
  write_endless_store(file("a.sqlite"));
  const ResultStore endless = ResultStore::open_existing(file("a.sqlite"));
  expect_error("endless steps", [&] { (void)endless.builds(); });
}

TEST_F(Store, RefusesAJournalThatNamesAFileToDelete) {
  (void)ResultStore::open(file("a.sqlite"));
  std::ofstream(file("a.sqlite-journal"), std::ios::binary) << "path of a file"
                                                            << "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::filesystem::create_symlink(file("a.sqlite"), file("link.sqlite"));
  for (const char* name : {"a.sqlite", "link.sqlite"}) {
    expect_error("names a file to delete", [&] { (void)ResultStore::open(file(name)); });
    expect_error("names a file to delete", [&] { (void)ResultStore::open_existing(file(name)); });
  }
}

TEST_F(Store, MergeTakesNothingThatCanNotBeRead) {
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

TEST_F(Store, ARemovedFolderIsCalledRemoved) {
  const auto folder = file("results");
  ResultStore store = ResultStore::open(folder / "a.sqlite");
  std::filesystem::remove_all(folder);
  expect_error("its folder was removed or replaced while in use",
               [&] { store.add("key", "", result_of(1)); });
}

TEST_F(Store, ALockNamesItsHolder) {
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

TEST(ResultJson, RefusesWhatIsNoCount) {
  TrialResult result = result_of(10);
  result.counts[0].instances = InstanceCounts{1, 2, 3, 4, 5, {{900, 6, {}}, {20, 7, {}}}};
  const std::string good = to_json(result);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    EXPECT_NE(bad.find(from), std::string::npos) << from << " in " << good;
    return bad.replace(bad.find(from), from.size(), to);
  };
  for (const char* key : {"predicted", "frames", "unreached", "sum_nm", "squared_error_billionth",
                          "boxes_unseen", "instances_void"})
    for (const char* value : {"-1", "1.5", "1e300", "18446744073709551615", "1000000000000000001",
                              "null", "\"7\"", "true"}) {
      const std::string name = fmt::format("\"{}\":", key);
      expect_error("is no count; delete the store and sweep again",
                   [&] { (void)result_from_json(with(name, name + value + ",\"x\":")); });
    }
  TrialResult twice = result_of(10);
  twice.counts[1] = twice.counts[0];
  std::string alike = to_json(twice);
  ASSERT_TRUE(alike.ends_with(",0]}")) << alike;
  expect_error("there is no class 7 before",
               [&] { (void)result_from_json(alike.replace(alike.size() - 3, 1, "7")); });
  for (const char* list : {"bins", "within"}) {
    const std::string name = fmt::format("\"{}\":[", list);
    expect_error("-1 is no count", [&] { (void)result_from_json(with(name, name + "-1,")); });
  }
  expect_error("is no thousandth", [&] { (void)result_from_json(with("[[900,", "[[1001,")); });
  for (const char* place : {"[900,", "[901,"})
    expect_error("steps do not fall", [&] { (void)result_from_json(with("[20,", place)); });
}

TEST(ResultJson, LeavesOutZeros) {
  TrialResult result = result_of(10);
  result.counts[1] = zero_counts(1, {{}, {0.01, 0.02}, {}}).front();
  result.counts[1].visible = 7;
  DistanceTally& far = result.counts[0].completeness = DistanceTally({0.01});
  for (const double distance_m : {0.0, 0.002, 0.9, 0.9015, 3.0}) far.add(distance_m);
  const std::string text = to_json(result);
  EXPECT_EQ(result_from_json(text).counts, result.counts);
  EXPECT_NE(text.find("\"bins\":[1,0,1,["), std::string::npos) << text;
  std::string bad = text;
  bad.replace(bad.find("[1,0,1,["), 8, "[1,0,1,[99999999999");
  expect_error("too many bins", [&] { (void)result_from_json(bad); });
}

TEST(ResultJson, RefusesWhatIsNotAResult) {
  EXPECT_EQ(result_from_json(to_json(result_of(3))).counts, result_of(3).counts);
  for (const char* text : {"", "{}", "{\"accounting\": 3}", "[1, 2"})
    expect_error("stored result", [&] { (void)result_from_json(text); });
}

}  // namespace
}  // namespace mapscore::eval
