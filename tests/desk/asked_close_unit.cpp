// SPDX-License-Identifier: MIT
// A person closes the window, saves, names a file: nothing that was carved is lost without a word.
#include "session/state/asked_close.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/desk/person_desk.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

// A desk whose work is in a document, and the place of that.
struct SavedDesk : PersonDesk {
    fs::path path = place() / "plate.burin";
    SavedDesk() {
        run({{CommandInput{"save-as", {path.string()}}, 10'000'000}});
        wait_for_disk();
        EXPECT_TRUE(fs::exists(path));
    }
};

TEST(ClosingTheWindow, EndsTheSessionAtOnceWhereNothingWasChanged) {
    PersonDesk desk;
    desk.close_window();
    EXPECT_TRUE(desk.has_quit());
    EXPECT_FALSE(desk.is_asked());
    SavedDesk saved;
    saved.close_window();
    EXPECT_TRUE(saved.has_quit());
}

TEST(ClosingTheWindow, AsksWhereAStrokeIsUnsavedAndEscGoesOn) {
    PersonDesk desk;
    desk.carve();
    for (const auto& close : std::vector<std::function<void()>>{
             [&] { desk.close_window(); }, [&] { desk.ctrl(Key::q); }, [&] { desk.press_button("quit"); }}) {
        close();
        EXPECT_FALSE(desk.has_quit());
        ASSERT_TRUE(desk.is_asked());
        for (const char* const answer : {"quit save", "quit discard", "quit stay"})
            EXPECT_TRUE(desk.desk->place_on_panel(answer)) << answer;
        desk.key(Key::escape);
        EXPECT_FALSE(desk.is_asked());
        EXPECT_FALSE(desk.has_quit());
    }
    const std::size_t before = desk.told().strokes;
    desk.carve(20.0);
    EXPECT_EQ(desk.told().strokes, before + 1) << "the work goes on";
}

TEST(ClosingTheWindow, AsksRightAfterTheButtonWasLetGo) {
    PersonDesk desk;
    desk.point_at({25.0, 30.0, PersonDesk::kTop_mm});
    desk.press();
    desk.drag(desk.px_of({25.0, 30.0, PersonDesk::kTop_mm}), desk.px_of({55.0, 30.0, PersonDesk::kTop_mm}));
    desk.run({{MouseClick{MouseButton::left, false, {}}, 10'000'000}, {WindowClose{}, 1'000'000}}, 20'000'000);
    EXPECT_FALSE(desk.has_quit());
}

TEST(ClosingTheWindow, LeavesMouseAndKeysToTheQuestion) {
    PersonDesk desk;
    desk.carve();
    desk.close_window();
    const std::size_t before = desk.told().strokes;
    const Similarity stood = desk.session().state().world_from_object;
    desk.carve(20.0);
    desk.key(Key::digit_5);
    desk.key(Key::left);
    EXPECT_EQ(desk.told().strokes, before);
    EXPECT_FALSE(desk.session().state().led().only_touch);
    EXPECT_EQ(desk.session().state().world_from_object, stood);
    EXPECT_TRUE(desk.is_asked());
}

TEST(ClosingTheWindow, SavesAndEndsWhenTheWorkIsOnTheDisk) {
    SavedDesk desk;
    desk.carve();
    ASSERT_EQ(saves_of(desk.path), 1);
    desk.close_window();
    ASSERT_TRUE(desk.is_asked());
    desk.key(Key::enter);
    desk.wait_for_disk();
    EXPECT_TRUE(desk.has_quit());
    EXPECT_EQ(saves_of(desk.path), 2);
    EXPECT_FALSE(desk.end().contains("is kept"));
    EXPECT_EQ(desk.journals(), 0u);
}

TEST(ClosingTheWindow, WaitsForASaveThatIsUnderWay) {
    SessionState state;
    state.asked.told = DocumentTold{.is = DocumentIs::saving, .has_file = true};
    ask_or_quit(state);
    EXPECT_EQ(state.asked.closing, Closing::saving);
    EXPECT_FALSE(state.quit);
    take_told(state, {.is = DocumentIs::saving, .has_file = true});
    EXPECT_FALSE(state.quit);
    SessionState saved = state, failed = state, changed = state;
    take_told(saved, {.is = DocumentIs::saved, .has_file = true, .saves = 1});
    EXPECT_TRUE(saved.quit);
    take_told(failed, {.is = DocumentIs::failed, .has_file = true, .saves = 1});
    EXPECT_FALSE(failed.quit);
    EXPECT_EQ(failed.asked.closing, Closing::no) << "the window stays open";
    take_told(changed, {.is = DocumentIs::changed, .has_file = true, .saves = 1});
    EXPECT_FALSE(changed.quit);
    EXPECT_EQ(changed.asked.closing, Closing::asked) << "there is work since the save";
}

TEST(ClosingTheWindow, ForgetsTheWorkWhereItsUserSaysSo) {
    SavedDesk desk;
    desk.carve();
    desk.close_window();
    desk.press_button("quit discard");
    EXPECT_TRUE(desk.has_quit());
    EXPECT_FALSE(desk.end().contains("is kept"));
    EXPECT_EQ(desk.journals(), 0u);
    EXPECT_EQ(saves_of(desk.path), 1);
}

TEST(ClosingTheWindow, StaysOpenWithTheErrorWhereTheSaveFails) {
    PersonDesk desk;
    desk.carve();
    desk.close_window();
    desk.key(Key::enter);
    desk.ctrl(Key::a);
    desk.type((desk.place() / "nowhere/plate.burin").string());
    testing::internal::CaptureStderr();
    desk.key(Key::enter);
    desk.wait_for_disk();
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_FALSE(desk.has_quit());
    EXPECT_FALSE(desk.is_asked());
    EXPECT_TRUE(said.contains("nowhere")) << said;
    EXPECT_TRUE(desk.desk->place_on_panel("message 0")) << "the error is shown";
    EXPECT_EQ(desk.shown(), "changed, kept: the one stroke");
}

TEST(ClosingTheWindow, AsksNobodyWhereAScriptIsTheUser) {
    PersonDesk desk;
    desk.carve();
    desk.tells = false;
    SessionState state = desk.session().state();
    state.asked.told.reset();
    ask_or_quit(state);
    EXPECT_TRUE(state.quit);
    MouseDesk scripted(plate(10.0));
    scripted.stroke({{25.0, 30.0, 10.0}, {55.0, 30.0, 10.0}});
    scripted.run({{WindowClose{}, 10'000'000}}, 50'000'000);
    EXPECT_TRUE(scripted.session().state().quit);
}

TEST(NamingTheWork, TypesAFilesNameWhoseLettersAreNoKeysOfTheSession) {
    PersonDesk desk;
    desk.carve();
    desk.ctrl(Key::s);
    ASSERT_TRUE(desk.is_asked()) << "work without a file has no name";
    desk.ctrl(Key::a);
    desk.type((desk.place() / "my 5 cats").string());
    EXPECT_FALSE(desk.session().state().led().only_touch);
    EXPECT_EQ(desk.viewer().output.mode, wall::StereoMode::mono);
    desk.key(Key::enter);
    desk.wait_for_disk();
    EXPECT_FALSE(desk.is_asked());
    EXPECT_EQ(saves_of(desk.place() / "my 5 cats.burin"), 1);
    EXPECT_EQ(short_name(desk.told()), "my 5 cats.burin");
    EXPECT_EQ(desk.shown(), "saved, all of it is saved");
    desk.carve(20.0);
    desk.ctrl(Key::s);
    desk.wait_for_disk();
    EXPECT_FALSE(desk.is_asked());
    EXPECT_EQ(saves_of(desk.place() / "my 5 cats.burin"), 2) << "from then on it has one";
}

TEST(NamingTheWork, AsksBeforeItReplacesAnothersFile) {
    SavedDesk desk;
    desk.place().write("other.burin", "another's");
    const fs::path other = desk.place() / "other.burin";
    desk.carve();
    desk.key(Key::s, {.shift = true, .ctrl = true});
    ASSERT_TRUE(desk.desk->place_on_panel("name"));
    desk.ctrl(Key::a);
    desk.type(other.string());
    desk.key(Key::enter);
    ASSERT_TRUE(desk.desk->place_on_panel("save-as replaced"));
    desk.key(Key::enter);  // another name is what Enter says
    EXPECT_EQ(desk.place().read("other.burin"), "another's");
    ASSERT_TRUE(desk.desk->place_on_panel("name"));
    desk.key(Key::enter);
    desk.press_button("save-as replaced");
    desk.wait_for_disk();
    EXPECT_EQ(saves_of(other), 1);
    EXPECT_EQ(short_name(desk.told()), "other.burin");
    EXPECT_EQ(desk.files_in(""), 2u);
}

TEST(NamingTheWork, GoesBackToTheQuestionOfClosing) {
    PersonDesk desk;
    desk.carve();
    desk.close_window();
    desk.press_button("quit save");
    ASSERT_TRUE(desk.desk->place_on_panel("name"));
    desk.key(Key::escape);
    EXPECT_FALSE(desk.desk->place_on_panel("name"));
    EXPECT_TRUE(desk.desk->place_on_panel("quit stay"));
    desk.press_button("quit save");
    desk.ctrl(Key::a);
    desk.type((desk.place() / "p").string());
    desk.press_button("save-as ok");
    desk.wait_for_disk();
    EXPECT_TRUE(desk.has_quit());
    EXPECT_EQ(saves_of(desk.place() / "p.burin"), 1);
}

TEST(TheDocument, IsSavedAgainOnceWhatWasChangedIsUndone) {
    SavedDesk desk;
    EXPECT_EQ(desk.shown(), "saved, all of it is saved");
    desk.carve();
    desk.carve(20.0);
    desk.wait_for_disk();
    EXPECT_EQ(desk.shown(), "changed, kept: all 2 strokes");
    desk.ctrl(Key::z);
    desk.wait_for_disk();
    EXPECT_EQ(desk.shown(), "changed, kept: the one stroke");
    desk.ctrl(Key::z);
    desk.wait_for_disk();
    EXPECT_EQ(desk.shown(), "saved, all of it is saved");
    desk.carve(40.0);
    desk.ctrl(Key::z);
    desk.ctrl(Key::y);
    desk.wait_for_disk();
    EXPECT_EQ(desk.shown(), "changed, kept: the one stroke");
    desk.close_window();
    EXPECT_FALSE(desk.has_quit());
}

TEST(TheDocument, OfWhichNoJournalIsKeptSaysSo) {
    DocumentTold told{.is = DocumentIs::changed, .keeps = true, .strokes = 12, .kept = 11};
    EXPECT_EQ(kept_text(told, "stroke"), "kept: up to stroke 11 of 12");
    told.kept = 12;
    EXPECT_EQ(kept_text(told, "stroke"), "kept: all 12 strokes");
    told.keeps = false;
    EXPECT_EQ(kept_text(told, "stroke"), "kept: nothing until it is saved");
}

}  // namespace
}  // namespace burin::session
