// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file_io.hpp"
#include "geometry/files/mesh_import.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

std::string why(const Result<void>& result) { return result ? "" : result.error().line(); }

TEST(AtomicWrite, ReplacesTheContentAndKeepsThePermissions) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.bin", "old");
    ::chmod(path.c_str(), 0640);
    ASSERT_EQ(why(write_file_atomically(path, geometry::test::bytes_of("new content"))), "");
    EXPECT_EQ(geometry::test::text_of_file(path), "new content");
    struct stat info{};
    ::stat(path.c_str(), &info);
    EXPECT_EQ(info.st_mode & 0777u, 0640u);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicWrite, WritesNoBytesAsAnEmptyFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(why(write_file_atomically(folder.path() / "empty", {})), "");
    EXPECT_EQ(std::filesystem::file_size(folder.path() / "empty"), 0u);
}

TEST(AtomicWrite, FollowsASymbolicLink) {
    const TemporaryFolder folder;
    const auto target = folder.write("target", "old");
    std::filesystem::create_symlink("target", folder.path() / "link");
    ASSERT_EQ(why(write_file_atomically(folder.path() / "link", geometry::test::bytes_of("new"))), "");
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
    EXPECT_EQ(geometry::test::text_of_file(target), "new");
}

TEST(AtomicWrite, RefusesFoldersDevicesAndMissingFoldersWithARemedy) {
    const TemporaryFolder folder;
    for (const std::filesystem::path& bad :
         {folder.path(), folder.path() / "", folder.path() / "missing" / "a.stl", std::filesystem::path("/dev/full"),
          folder.write("file", "x") / "a.stl", folder.path() / std::string(300, 'n')}) {
        const auto result = write_file_atomically(bad, geometry::test::bytes_of("x"));
        ASSERT_FALSE(result) << bad;
        EXPECT_EQ(result.error().where, bad.string());
        EXPECT_FALSE(result.error().remedy.empty());
    }
    EXPECT_EQ(folder.entries(), 1u);
}

// A limit on the size of files makes the write fail half-way, as a full disk does.
int write_with_little_room(const std::filesystem::path& path) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const auto result = write_file_atomically(path, std::vector<std::byte>(100000, std::byte{'n'}));
    return !result && !result.error().remedy.empty() ? 0 : 1;
}

TEST(AtomicWrite, LeavesTheOldFileAndNothingElseWhenTheDiskIsFull) {
    const TemporaryFolder folder;
    const auto path = folder.write("precious.stl", "old content");
    const pid_t child = ::fork();
    if (child == 0) ::_exit(write_with_little_room(path));
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(geometry::test::text_of_file(path), "old content");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicWrite, RefusesAFolderThatIsWriteProtected) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere, so the refusal cannot be provoked";
    const TemporaryFolder folder;
    const auto old = folder.write("a.stl", "old");
    ::chmod(folder.path().c_str(), 0500);
    EXPECT_FALSE(write_file_atomically(old, geometry::test::bytes_of("new")));
    EXPECT_FALSE(write_file_atomically(folder.path() / "b.stl", geometry::test::bytes_of("new")));
    ::chmod(folder.path().c_str(), 0700);
    EXPECT_EQ(geometry::test::text_of_file(old), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(ReadFile, RefusesWhatIsNotAReadableFileOfBoundedSize) {
    const TemporaryFolder folder;
    const auto fifo = folder.path() / "fifo";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    for (const std::filesystem::path& bad :
         {folder.path(), folder.path() / "missing", fifo, std::filesystem::path("/dev/zero")}) {
        const auto result = read_file(bad);
        ASSERT_FALSE(result) << bad;
        EXPECT_EQ(result.error().where, bad.string());
        EXPECT_FALSE(result.error().remedy.empty());
    }
    EXPECT_FALSE(read_file(folder.write("long", "12345"), 4));
    EXPECT_EQ(read_file(folder.write("fits", "1234"), 4).value().size(), 4u);
}

TEST(ReadFile, RefusesAHugeSparseFileWithoutTakingMemoryForIt) {
    const TemporaryFolder folder;
    const auto path = folder.write("sparse.stl", "");
    std::filesystem::resize_file(path, kMaxFileBytes + 1);
    EXPECT_FALSE(read_file(path));
}

TEST(MeshFiles, AreRefusedWithTheReasonThatHelpsMost) {
    const TemporaryFolder folder;
    const auto message = [](const std::filesystem::path& path) {
        const auto result = geometry::import_mesh(path);
        return result ? std::string("accepted") : result.error().what;
    };
    EXPECT_EQ(message(folder.path()), "is a folder");
    EXPECT_EQ(message(folder.path() / "gone"), "does not exist");
    EXPECT_EQ(message(folder.write("mesh.step", "x")), "has an extension that is not a mesh format");
    EXPECT_EQ(message(folder.write("mesh.ply", "")), "is empty");
    std::filesystem::create_directory(folder.path() / "folder.stl");
    EXPECT_EQ(message(folder.path() / "folder.stl"), "is a folder");
    EXPECT_NE(message(folder.path() / "gone.stl").find("No such file"), std::string::npos);
    const auto secret = folder.write("secret.obj", "v 0 0 0\n");
    ::chmod(secret.c_str(), 0);
    if (::geteuid() != 0) {  // the superuser reads everything
        EXPECT_NE(message(secret).find("ermission"), std::string::npos);
    }
}

TEST(MeshFiles, OfOneFormatUnderAnotherNameAreRefused) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const MeshFormat format : {MeshFormat::stl, MeshFormat::ply, MeshFormat::off})
        EXPECT_NE(geometry::test::refusal(obj, format), "");
    for (const MeshFormat format : {MeshFormat::stl, MeshFormat::ply, MeshFormat::obj})
        EXPECT_NE(geometry::test::refusal(off, format), "");
}

}  // namespace
}  // namespace burin::geometry::test
