// Reading OBJ text number by number, with line numbers for messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace paim {

// The text made fit for a message: at most 40 characters, control and non-ASCII bytes as '?'.
std::string printable(std::string_view text);

// A cursor over OBJ text. It also rewrites the text in place so that a less careful parser reads
// the same from it: continued lines are joined and comments at the end of a line blanked, with
// spaces, so that no byte moves.
class ObjText {
  public:
    // name  of the file, for messages; must outlive the cursor
    ObjText(const std::string& name, std::span<char> text);

    bool at_end() const { return at_ == end_; }
    size_t line() const { return line_; }  // from 1

    // The first word of the line (up to a space), or nothing on an empty line. Leading space is
    // skipped.
    std::string_view read_keyword();
    // Turns the line whose keyword was just read into a comment.
    void comment_out_line() { *keyword_ = '#'; }
    // Blanks what remains of the line.
    void blank_rest_of_line();
    // What remains of the line, without space at either end.
    std::string_view read_rest_of_line();
    void next_line();

    // Skips space and continuations; true if another word follows on this line.
    bool find_word();
    // Skips a finite decimal number within float's range that fills the whole word. Numbers far too
    // small for float become 0 in the text.
    // what  is named in the error (bad input) if the word is anything else
    void skip_number(const char* what);
    // The same, and the number as a double.
    double read_number(const char* what);
    // An integer, up to where the digits end. False if it exceeds 64 bits, in which case the digits
    // are skipped. Error (bad input) if there is none; `what` is named.
    bool read_integer(const char* what, int64_t& value);
    // Skips one character if it is `c`.
    bool skip(char c);
    bool at_word_end() const;
    // The whole word that contains the character before the cursor or at it.
    std::string_view word_from(const char* start) const;
    const char* position() const { return at_; }

    // Error (bad input): "name:line: message".
    [[noreturn]] void fail(std::string_view message) const;

  private:
    bool at_line_end() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }
    // Bytes of a backslash and the line end behind it, or 0.
    size_t continuation_size(const char* at) const;
    void skip_unusual_number(char* start, const char* what);

    const std::string& name_;
    char* at_;
    char* end_;
    char* keyword_ = nullptr;
    size_t line_ = 1;
};

}  // namespace paim
