// Manual pages in the language of man(7).

#include <cstdint>
#include <cstdio>

#include "bihive/base/ascii.h"
#include "words/program_words.h"

namespace bihive::cli {
namespace {

// Escapes text for roff: a backslash, a hyphen that people copy, and letters beyond ASCII have names of their own; a
// line that begins with a period or a quote would be a request.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte == '\\') {
      out += "\\e";
    } else if (byte == '-') {
      out += "\\-";
    } else if (byte == '\'') {
      out += "\\(aq";
    } else if (byte == '^' || byte == '~') {
      out += byte == '^' ? "\\(ha" : "\\(ti";
    } else if (byte < 0x80) {
      out += text[i];
    } else {
      // UTF-8: the first byte tells how many follow.
      const int more = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
      std::uint32_t code = byte & (0x3fu >> more);
      for (int k = 0; k < more && i + 1 < text.size(); ++k)
        code = (code << 6) | (static_cast<unsigned char>(text[++i]) & 0x3fu);
      char name[16];
      std::snprintf(name, sizeof(name), "\\[u%04X]", static_cast<unsigned>(code));
      out += name;
    }
  }
  if (!out.empty() && out.front() == '.') out.insert(0, "\\&");
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}
std::string slanted(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

std::string with_small_letter(std::string text) {
  if (!text.empty()) text[0] = lower_case(text[0]);
  return text;
}

std::string title(const ProgramWords& words, const std::string& name, const std::string& purpose) {
  return ".\\\" Written by bihive describe man.\n.TH " + upper_case(name) + " 1 \"\" \"bihive " + words.version +
         "\" \"User commands\"\n.nh\n.ad l\n.SH NAME\n" + name + " \\- " + roff(purpose) + "\n";
}

std::string option_paragraph(const OptionWords& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (names.empty()) names = slanted(option.place);
  if (!option.type.empty() && !option.names.empty()) names += " " + slanted(option.type);
  return ".TP\n" + names + "\n" + roff(option.help) + (option.required ? " (required)" : "") + "\n";
}

std::string synopsis(const CommandWords& command) {
  std::string text = ".SH SYNOPSIS\n" + bold("bihive " + command.name);
  for (const OptionWords& option : command.options)
    if (!option.place.empty())
      text += (option.required ? " " + slanted(option.place) : " [" + slanted(option.place) + "]") +
              (option.repeatable ? "..." : "");
  for (const OptionWords& option : command.options)
    if (option.place.empty() && option.required) text += " " + bold(option.names.front()) + " " + slanted(option.type);
  return text + " [" + slanted("OPTION") + "]...\n";
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n\\fB0\\fR\nDone.\n"
    ".TP\n\\fB1\\fR\nAn input is wrong, or an output cannot be written.\n"
    ".TP\n\\fB2\\fR\nThe command line is wrong.\n"
    ".TP\n\\fB3\\fR\nThe machine lacks something: a driver, a screen, a program.\n"
    ".TP\n\\fB130\\fR\nInterrupted by Ctrl\\-C.\n";

constexpr const char* kEnvironmentSection =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBBIHIVE_TARGET\\fR\nThe instruction set that the program uses, such as \\fBavx2\\fR. Every one gives the "
    "same bits.\n"
    ".TP\n\\fBBIHIVE_PAGE\\fR\nThe folder with the page that \\fBbihive web\\fR serves.\n"
    ".TP\n\\fBBIHIVE_EGL\\fR\nThe library of EGL by which the engine \\fBgpu\\fR reaches a graphics processor.\n"
    ".TP\n\\fBTMPDIR\\fR\nThe folder in which large packed files are unpacked (/var/tmp).\n";

std::string program_page(const ProgramWords& words) {
  std::string text = title(words, "bihive", "ray tracing of spheres on a bounding interval hierarchy");
  text += ".SH SYNOPSIS\n" + bold("bihive") + " " + slanted("COMMAND") + " [" + slanted("ARGUMENT") + "]... [" +
          slanted("OPTION") + "]...\n";
  text +=
      ".SH DESCRIPTION\n"
      "bihive turns molecules, particle simulations and point sets into pictures, and measures the trees behind them. "
      "Each command has a manual page of its own.\n"
      ".SH COMMANDS\n";
  for (const CommandWords& command : words.commands)
    text += ".TP\n\\fBbihive\\-" + command.name + "\\fR(1)\n" + roff(command.help) + ".\n";
  text += ".SH OPTIONS\n";
  for (const OptionWords& option : words.program.options) text += option_paragraph(option);
  text += kExitStatus;
  text += kEnvironmentSection;
  text += ".SH EXAMPLES\n.EX\n";
  for (const CommandWords& command : words.commands)
    if (!command.examples.empty()) text += roff(command.examples.front()) + "\n";
  return text + ".EE\n";
}

std::string command_page(const ProgramWords& words, const CommandWords& command) {
  std::string text = title(words, "bihive-" + command.name, with_small_letter(command.help));
  text += synopsis(command);
  std::string places;
  std::string options;
  for (const OptionWords& option : command.options) {
    if (option.place.empty()) {
      options += option_paragraph(option);
      continue;
    }
    OptionWords place = option;
    place.names.clear();
    places += option_paragraph(place);
    if (option.names.empty()) continue;
    options += ".TP\n" + bold(option.names.front()) + " " + slanted(option.type) + "\nThe same as " +
               slanted(option.place) + ".\n";
  }
  if (!places.empty()) text += ".SH ARGUMENTS\n" + places;
  text += ".SH OPTIONS\n" + options;
  if (!command.examples.empty()) {
    text += ".SH EXAMPLES\n.EX\n";
    for (const std::string& example : command.examples) text += roff(example) + "\n";
    text += ".EE\n";
  }
  return text + kExitStatus + ".SH SEE ALSO\n\\fBbihive\\fR(1)\n";
}

}  // namespace

std::string man_page(const ProgramWords& words, const std::string& command) {
  if (command.empty()) return program_page(words);
  for (const CommandWords& known : words.commands)
    if (known.name == command) return command_page(words, known);
  return "";
}

}  // namespace bihive::cli
