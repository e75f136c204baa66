#include "records/with_values.h"

#include <algorithm>
#include <array>

#include "base/utf8_text.h"
#include "records/reading_columns.h"
#include "records/table_line.h"

namespace trunnion::records {
namespace {

/// value_mm and value_deg.
struct ValueColumn {
    const ReadingColumn* column;
    std::size_t cell = 0;  ///< its place in a row
    bool in_file = false;
    bool needed = false;  ///< by a row
};

class Rewriter {
  public:
    explicit Rewriter(const ReadingTable& read)
        : read_(read),
          values_{{{find_reading_column("value_mm")}, {find_reading_column("value_deg")}}} {
        for (const Reading& row : read.rows)
            if (row.device != Device::none) values_[row.angular ? 1 : 0].needed = true;
    }

    std::string text(std::string_view in) {
        std::string out;
        TableLine line{{}, 0, read_.path};
        while (!in.empty()) {
            const std::string_view from = in;
            line.text = take_line(in);
            ++line.number;
            const std::string_view end =
                from.substr(line.text.size(), from.size() - line.text.size() - in.size());
            if (without_blanks(line.text).empty())
                out += line.text;
            else if (line.text[0] == '#')
                out += head_line(line.text);
            else if (!header_done_)
                header(line, out);
            else
                row(line, read_.rows[next_++], out);
            out += end;
        }
        return out;
    }

  private:
    /// The declared geometry beside which the values stand is that of `read`.
    std::string head_line(std::string_view written) const {
        const std::size_t equal = written.find('=');
        const std::string key(
            without_blanks(written.substr(1, std::min(equal, written.size()) - 1)));
        const auto told = read_.comment.find(key);
        if (!key.starts_with(declared_key) || told == read_.comment.end())
            return std::string(written);
        return "# " + key + " = " + told->second;
    }

    void header(const TableLine& line, std::string& out) {
        separator_ = separator_of(line.text);
        line.split(separator_, cells_);
        out += line.text;
        for (ValueColumn& value : values_) {
            const auto found = std::find_if(cells_.begin(), cells_.end(), [&](auto& cell) {
                return cell.text == value.column->name;
            });
            value.in_file = found != cells_.end();
            value.cell = static_cast<std::size_t>(found - cells_.begin());
            if (!value.in_file && value.needed) (out += separator_) += value.column->name;
        }
        header_done_ = true;
    }

    void row(const TableLine& line, const Reading& reading, std::string& out) {
        const bool replaces = reading.device != Device::none;
        line.split(separator_, cells_);
        std::size_t done = 0;
        for (std::size_t i = 0; i < cells_.size() && replaces; ++i)
            for (const ValueColumn& value : values_) {
                if (!value.in_file || value.cell != i) continue;
                const auto at = static_cast<std::size_t>(cells_[i].text.data() - line.text.data());
                out += line.text.substr(done, at - done);
                out += value.column->text(reading);
                done = at + cells_[i].text.size();
            }
        out += line.text.substr(done);
        for (const ValueColumn& value : values_)
            if (!value.in_file && value.needed)
                (out += separator_) += replaces ? value.column->text(reading) : "";
    }

    const ReadingTable& read_;
    std::array<ValueColumn, 2> values_;
    std::vector<TableCell> cells_;
    std::size_t next_ = 0;
    char separator_ = ',';
    bool header_done_ = false;
};

}  // namespace

std::string with_values(std::string_view text, const ReadingTable& read) {
    const std::string converted = is_utf16(text) ? utf8_of(std::string(text), read.path) : "";
    if (!converted.empty()) text = converted;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return Rewriter(read).text(text);
}

}  // namespace trunnion::records
