#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "report/page_assets.h"
#include "report/xml.h"

namespace trunnion::report {
namespace {

std::string_view tone_class(Tone tone) {
    switch (tone) {
        case Tone::good: return " good";
        case Tone::bad: return " bad";
        case Tone::neutral: break;
    }
    return "";
}

/// JSON in a script element must not end the element.
std::string json_in_html(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

const PageAsset* script_of(PageScript script) {
    switch (script) {
        case PageScript::chart: return &chart_script;
        case PageScript::run: return &run_script;
        case PageScript::none: break;
    }
    return nullptr;
}

std::string head_html(const Page& page) {
    const PageAsset* script = script_of(page.script);
    const std::string allowed = script ? fmt::format("'{}'", script->hash) : "'none'";
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
        "script-src {}; style-src '{}'; img-src data:; base-uri 'none'; form-action 'none'\">\n"
        "<link rel=\"icon\" href=\"data:,\">\n"
        "<title>{}</title>\n<style>{}</style>\n</head>\n",
        allowed, page_style.hash, escape_xml(page.title), page_style.text);
}

/// A command whose lines break between words only: an option keeps its hyphens together.
std::string command_html(const std::string& command) {
    std::string out;
    for (std::size_t from = 0, end; from < command.size(); from = end + 1) {
        end = std::min(command.find(' ', from), command.size());
        const std::string word = escape_xml(command.substr(from, end - from));
        out += from == 0 ? "" : " ";
        out +=
            word.find('-') == std::string::npos ? word : "<span class=\"word\">" + word + "</span>";
    }
    return out;
}

std::string footer_html(const PageOrigin& origin) {
    std::string out = "<footer>\n";
    if (!origin.command.empty())
        out += fmt::format("<p>Made by <code>{}</code></p>\n", command_html(origin.command));
    std::string line = fmt::format("trunnion {}", escape_xml(origin.version));
    if (origin.seed) line += fmt::format(", seed {}", *origin.seed);
    if (!origin.date.empty()) line += ", " + escape_xml(origin.date);
    out += "<p>" + line + "</p>\n";
    for (const PageInput& input : origin.inputs)
        out += fmt::format("<p><code>{}</code> SHA-256 <code>{}</code></p>\n",
                           escape_xml(input.path), escape_xml(input.sha256));
    return out + "</footer>\n";
}

std::string row_html(const std::vector<std::string>& cells, const std::string& alignment,
                     const char* tag) {
    std::string out = "<tr>";
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const bool number = k < alignment.size() && alignment[k] == 'r';
        out += fmt::format("<{0}{1}>{2}</{0}>", tag, number ? " class=\"number\"" : "",
                           escape_xml(cells[k]));
    }
    return out + "</tr>\n";
}

}  // namespace

std::string page_html(const Page& page) {
    std::string out = head_html(page);
    out += fmt::format("<body>\n<main>\n<h1>{}</h1>\n", escape_xml(page.title));
    if (!page.subject.empty())
        out += fmt::format("<p class=\"subject\">{}</p>\n", escape_xml(page.subject));
    if (!page.verdict.empty())
        out += fmt::format("<p class=\"verdict{}\">{}</p>\n", tone_class(page.tone),
                           escape_xml(page.verdict));
    out += page.body_html + "</main>\n" + footer_html(page.origin);
    if (const PageAsset* script = script_of(page.script)) {
        out += "<script type=\"application/json\" id=\"data\">" + json_in_html(page.data_json) +
               "</script>\n";
        out += fmt::format("<script>{}</script>\n", script->text);
    }
    return out + "</body>\n</html>\n";
}

std::string section_html(const std::string& heading, const std::string& body_html) {
    return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape_xml(heading), body_html);
}

std::string figure_html(const std::string& svg, const std::string& caption) {
    return fmt::format(
        "<figure>\n<div class=\"scroll\" "
        "tabindex=\"0\">{}</div>\n<figcaption>{}</figcaption>\n</figure>\n",
        svg, escape_xml(caption));
}

std::string paragraph_html(const std::string& text) {
    return "<p>" + escape_xml(text) + "</p>\n";
}

std::string table_html(const PageTable& table) {
    std::string out = "<div class=\"scroll\" tabindex=\"0\"><table>\n";
    if (!table.caption.empty())
        out += fmt::format("<caption>{}</caption>\n", escape_xml(table.caption));
    if (!table.header.empty())
        out += "<thead>" + row_html(table.header, table.alignment, "th") + "</thead>\n";
    out += "<tbody>\n";
    for (const auto& row : table.rows) out += row_html(row, table.alignment, "td");
    return out + "</tbody>\n</table></div>\n";
}

}  // namespace trunnion::report
