#include "interpreter/program_files.h"

#include <algorithm>
#include <utility>

#include "interpreter/keywords.h"
#include "interpreter/lexical.h"
#include "interpreter/line_scan.h"

namespace trunnion::interpreter {
namespace {

constexpr int outside = -2;                    ///< instead of a file id: from the source only
constexpr std::size_t largest_index = 300000;  ///< maximum number of N numbers indexed for one
                                               ///< program: 4.8 MB

bool by_number(const Numbered& a, const Numbered& b) {
    return a.number != b.number ? a.number < b.number : a.byte < b.byte;
}

bool begins_other(const LineHead& head, const Section& section) {
    return head.kind == LineKind::over ||
           (head.kind == LineKind::program && head.place.byte > section.begin.byte);
}

/// The loop statement at the beginning of a line: DO n > 0, END n < 0, neither 0.
int loop_step(const LineHead& head, const char* end) {
    const char* p = head.content;
    if (p == end || !is_letter(*p)) return 0;
    const Keyword keyword = read_keyword(p, end);
    if (keyword == Keyword::while_) {
        const char* const stop = find_line_end(p, end);
        while (p != stop && !(upper(*p) == 'D' && p + 1 != stop && upper(p[1]) == 'O')) ++p;
        if (p == stop) return 0;
        p += 2;
    } else if (keyword != Keyword::do_ && keyword != Keyword::end) {
        return 0;
    }
    p = skip_blanks(p, end);
    const int number = p != end && *p >= '1' && *p <= '3' ? *p - '0' : 0;
    return keyword == Keyword::end ? -number : number;
}

/// True when the last word of a line, before comments, is THEN.
bool ends_with_then(const char* p, const char* end) {
    char last[4] = {};
    bool comment = false;
    for (const char* const stop = find_line_end(p, end); p != stop && *p != ';'; ++p) {
        if (*p == '(' || *p == ')') comment = *p == '(';
        if (comment || *p == ')' || *p == ' ' || *p == '\t') continue;
        std::copy(last + 1, last + 4, last);
        last[3] = upper(*p);
    }
    return std::string_view(last, 4) == "THEN";
}

/// The branch statement at the beginning of a line: IF .. THEN alone 1, ELSE 0, ENDIF -1.
std::optional<int> branch_step(const LineHead& head, const char* end) {
    const char* p = head.content;
    if (p == end || !is_letter(*p)) return std::nullopt;
    const Keyword keyword = read_keyword(p, end);
    if (keyword == Keyword::else_) return 0;
    if (keyword == Keyword::if_ && ends_with_then(p, end)) return 1;
    p = skip_blanks(p, end);
    if (keyword == Keyword::end && p != end && upper(*p) == 'I') return -1;
    return std::nullopt;
}

/// "/USER/PATH1/" of a line `&F=/USER/PATH1/`.
std::string folder_name(const char* p, const char* end) {
    std::string name;
    for (p = std::find(p, end, '/'); p != end && !is_line_end(*p) && !is_blank(*p); ++p)
        name += upper(*p);
    return name;
}

/// The folder that a place of the file lies in, -1: none.
int folder_at(const ProgramFile& file, std::uint64_t byte) {
    int folder = -1;
    for (const FolderStart& start : file.folders)
        if (start.byte <= byte) ++folder;
    return folder;
}

/// Which of several programs of one number is called; the lowest rank is.
int rank_of(const ProgramFile& file, std::uint64_t byte, const Section* near) {
    if (file.folders.empty()) return 0;
    const int folder = folder_at(file, byte);
    if (folder < 0) return 1;
    const std::string& name = file.folders[static_cast<std::size_t>(folder)].name;
    if (near && near->file == &file) {
        const int own = folder_at(file, near->begin.byte);
        if (own >= 0 && file.folders[static_cast<std::size_t>(own)].name == name) return 0;
    }
    int rank = 1;
    for (const std::string_view known :
         {"/USER/PATH", "/USER/LIBRARY/", "/MTB2/", "/MTB1/", "/SYSTEM/"}) {
        if (name.find(known) != name.npos) return rank;
        ++rank;
    }
    return rank;
}

}  // namespace

ProgramFile& ProgramFiles::add(const ProgramText& text) {
    for (auto& file : files_)
        if (file->text.text.data() == text.text.data() &&
            file->text.text.size() == text.text.size())
            return *file;
    auto file = std::make_unique<ProgramFile>();
    file->id = static_cast<int>(files_.size());
    file->text = text;
    files_.push_back(std::move(file));
    return *files_.back();
}

Section& ProgramFiles::section_at(ProgramFile& file, TextPlace place, int o_number) {
    for (auto& section : sections_)
        if (section->file == &file && section->begin.byte == place.byte) return *section;
    auto section = std::make_unique<Section>();
    section->file = &file;
    section->begin = place;
    section->o_number = o_number;
    section->read_to = place.byte;
    sections_.push_back(std::move(section));
    return *sections_.back();
}

/// Blank lines, `%` lines, folder lines and comments before the first program are skipped.
Section& ProgramFiles::open(const ProgramText& text) {
    ProgramFile& file = add(text);
    std::optional<LineHead> first;
    for (LineScan scan(text.text, start_of_text(text.text)); scan.next();) {
        const LineHead& head = scan.head();
        if (head.kind == LineKind::blank ||
            (head.kind == LineKind::over && *head.content != control_z))
            continue;
        first = head;
        break;
    }
    if (!first) return section_at(file, {text.text.size(), 1}, 0);
    return section_at(file, first->place, first->kind == LineKind::program ? first->number : 0);
}

void ProgramFiles::list(ProgramFile& file) {
    if (std::exchange(file.listed, true)) return;
    const std::string_view text = file.text.text;
    const char* const end = text.data() + text.size();
    for (LineScan scan(text, start_of_text(text)); scan.next();) {
        const LineHead& head = scan.head();
        if (head.kind == LineKind::program && head.number > 0)
            file.programs.push_back({head.number, head.place.line, head.place.byte});
        if (head.kind == LineKind::over && *head.content == '&')
            file.folders.push_back({head.place.byte, folder_name(head.content, end)});
    }
    std::stable_sort(file.programs.begin(), file.programs.end(), by_number);
}

ProgramFiles::Caller ProgramFiles::caller_of(const Section* near) {
    if (!near) return {-1, -1};
    list(*near->file);
    return {near->file->id, folder_at(*near->file, near->begin.byte)};
}

Section* ProgramFiles::find_in(ProgramFile& file, int number, const Section* near) {
    list(file);
    const auto [first, last] =
        std::equal_range(file.programs.begin(), file.programs.end(), Numbered{number, 0, 0},
                         [](const Numbered& a, const Numbered& b) { return a.number < b.number; });
    if (first == last) return nullptr;
    const auto rank = [&](const Numbered& program) { return rank_of(file, program.byte, near); };
    const auto best = std::min_element(
        first, last, [&](const Numbered& a, const Numbered& b) { return rank(a) < rank(b); });
    return &section_at(file, {best->byte, best->line}, number);
}

Section* ProgramFiles::find(int number, const Section* near) {
    const auto key = std::make_pair(caller_of(near), number);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    Section* section = near ? find_in(*near->file, number, near) : nullptr;
    if (!section && !files_.empty()) section = find_in(*files_.front(), number, near);
    if (!section) section = find_outside(number);
    return found_[key] = section;
}

Section* ProgramFiles::find_in(ProgramFile& file, std::string_view name, const Section* near) {
    list(file);
    const std::string_view text = file.text.text;
    const std::string wanted = "<" + std::string(name) + ">";
    std::optional<std::pair<int, TextPlace>> best;
    for (LineScan scan(text, start_of_text(text)); scan.next();) {
        const LineHead& head = scan.head();
        if (head.kind != LineKind::program || *head.content != '<') continue;
        const auto at = static_cast<std::size_t>(head.content - text.data());
        if (text.compare(at, wanted.size(), wanted) != 0) continue;
        const int rank = rank_of(file, head.place.byte, near);
        if (!best || rank < best->first) best = {rank, head.place};
    }
    return best ? &section_at(file, best->second, 0) : nullptr;
}

Section* ProgramFiles::find(std::string_view name, const Section& near) {
    const auto key = std::make_pair(caller_of(&near), std::string(name));
    const auto known = named_.find(key);
    if (known != named_.end()) return known->second;
    Section* section = find_in(*near.file, name, &near);
    if (!section) {
        if (const auto number = number_of_name(name)) section = find(*number, &near);
    }
    if (!section) {
        const std::optional<ProgramText> text = source_.find(name);
        if (text) section = find_in(add(*text), name, nullptr);
        if (text && !section) section = &open(*text);
    }
    return named_[key] = section;
}

Section* ProgramFiles::find_outside(int number) {
    const auto key = std::make_pair(Caller{outside, -1}, number);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    Section*& section = found_[key];
    const std::optional<ProgramText> text = source_.find(number);
    if (!text) return section = nullptr;
    section = find_in(add(*text), number, nullptr);
    if (section) return section;
    section = &open(*text);
    if (section->o_number == 0) section->o_number = number;
    return section;
}

void ProgramFiles::build_index(Section& section) {
    for (auto& other : sections_) {  // only one large index at a time, to bound memory
        if (other->index.size() < largest_index / 10) continue;
        other->index = {};
        other->indexed = false;
    }
    section.indexed = true;
    for (LineScan scan(section.file->text.text, section.begin); scan.next();) {
        const LineHead& head = scan.head();
        ++lines_searched_;
        if (begins_other(head, section)) break;
        if (head.sequence_number < 0) continue;
        if (section.index.size() == largest_index) {
            section.index = {};
            section.index_too_large = true;
            return;
        }
        section.index.push_back({head.sequence_number, head.place.line, head.place.byte});
    }
    std::sort(section.index.begin(), section.index.end(), by_number);
}

std::optional<TextPlace> ProgramFiles::search_text(const Section& section, int number,
                                                   std::uint64_t after) {
    std::optional<TextPlace> before;
    for (LineScan scan(section.file->text.text, section.begin); scan.next();) {
        const LineHead& head = scan.head();
        ++lines_searched_;
        if (begins_other(head, section)) break;
        if (head.sequence_number != number) continue;
        if (head.place.byte > after) return head.place;
        if (!before) before = head.place;
    }
    return before;
}

std::optional<TextPlace> ProgramFiles::find_sequence(Section& section, int number,
                                                     std::uint64_t after) {
    if (!section.indexed && !section.index_too_large) build_index(section);
    if (section.index_too_large) return search_text(section, number, after);
    const auto& index = section.index;
    const auto from = [&](std::uint64_t byte) {
        return std::lower_bound(index.begin(), index.end(), Numbered{number, 0, byte}, by_number);
    };
    auto it = from(after + 1);
    if (it == index.end() || it->number != number) it = from(0);
    if (it == index.end() || it->number != number) return std::nullopt;
    return TextPlace{it->byte, it->line};
}

std::optional<TextPlace> ProgramFiles::find_loop_end(const Section& section, TextPlace from,
                                                     int number) {
    const std::string_view text = section.file->text.text;
    std::vector<int> open{number};
    for (LineScan scan(text, from); scan.next();) {
        ++lines_searched_;
        if (begins_other(scan.head(), section)) return std::nullopt;
        const int step = loop_step(scan.head(), text.data() + text.size());
        if (step > 0 && std::find(open.begin(), open.end(), step) != open.end())
            return std::nullopt;
        if (step > 0) open.push_back(step);
        if (step >= 0) continue;
        if (open.back() != -step) return std::nullopt;
        open.pop_back();
        if (open.empty()) return scan.behind();
    }
    return std::nullopt;
}

std::optional<TextPlace> ProgramFiles::find_branch_end(const Section& section, TextPlace from,
                                                       bool to_else) {
    const std::string_view text = section.file->text.text;
    int depth = 0;
    for (LineScan scan(text, from); scan.next();) {
        ++lines_searched_;
        if (begins_other(scan.head(), section)) return std::nullopt;
        const auto step = branch_step(scan.head(), text.data() + text.size());
        if (!step) continue;
        const bool here = *step < 0 || (*step == 0 && to_else);
        if (depth == 0 && here) return scan.behind();
        depth += *step;
    }
    return std::nullopt;
}

void ProgramFiles::forget_first_blocks() {
    for (auto& section : sections_) section->first_block = -1;
}

}  // namespace trunnion::interpreter
