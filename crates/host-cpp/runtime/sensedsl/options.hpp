// The command line of a host application.
//
// In: a table of options and the arguments. Out: what was given, or why it cannot be; and the text of
// `--help`. C++98.
#ifndef SENSEDSL_OPTIONS_HPP
#define SENSEDSL_OPTIONS_HPP

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <map>
#include <string>
#include <vector>

namespace sensedsl {

/// One option: `--name`, or `--name=VALUE` where it has a value; one in brackets may be left out.
struct Option {
    const char *name;
    /// What stands for the value in the help; NULL for an option without one.
    const char *value;
    const char *help;
};

/// Options as given, and the words beside them.
class Options {
public:
    Options(const Option *known, size_t count) : known_(known, known + count), given_(), words_() {}

    /// Reads the arguments. What is wrong with them; empty when nothing is.
    std::string read(int argc, char **argv) {
        bool are_options = true;
        for (int i = 1; i < argc; ++i) {
            const std::string word = argv[i];
            if (are_options && word == "--") {
                are_options = false;
            } else if (!are_options || word.size() < 2 || word[0] != '-') {
                words_.push_back(word);
            } else {
                const std::string problem = read_option(word == "-h" ? "--help" : word);
                if (!problem.empty()) {
                    return problem;
                }
            }
        }
        return std::string();
    }

    bool has(const std::string &name) const { return given_.count(name) != 0; }
    /// The value given; empty when there is none.
    std::string value(const std::string &name) const {
        const std::map<std::string, std::string>::const_iterator found = given_.find(name);
        return found != given_.end() ? found->second : std::string();
    }
    /// What is no option.
    const std::vector<std::string> &words() const { return words_; }

    /// What is wrong with `--health`, in seconds; empty when nothing is, and then `every_ms` is it, 0
    /// without the option.
    std::string read_health(int64_t &every_ms) const {
        every_ms = 0;
        if (!has("health")) {
            return std::string();
        }
        const std::string given = value("health");
        char *end = NULL;
        const double seconds = strtod(given.c_str(), &end);
        const bool is_number = given.find_first_not_of("0123456789.") == std::string::npos && *end == '\0';
        if (!is_number || seconds < 0.1 || seconds > 3600.0) {
            return "how many seconds between questions for health? 0.1 to 3600, not " + given;
        }
        every_ms = static_cast<int64_t>(seconds * 1000.0 + 0.5);
        return std::string();
    }

    /// A line for each option.
    std::string help() const {
        std::string text;
        for (size_t i = 0; i < known_.size(); ++i) {
            std::string line = "  " + spelling(known_[i]);
            line.resize(line.size() < 24 ? 24 : line.size() + 2, ' ');
            text += line + known_[i].help + "\n";
        }
        return text;
    }

private:
    static std::string spelling(const Option &option) {
        const std::string name = std::string("--") + option.name;
        if (option.value == NULL) {
            return name;
        }
        return is_optional(option) ? name + "[=" + (option.value + 1) : name + "=" + option.value;
    }

    static bool is_optional(const Option &option) { return option.value != NULL && option.value[0] == '['; }

    std::string read_option(const std::string &word) {
        const size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        for (size_t i = 0; i < known_.size(); ++i) {
            if (name != std::string("--") + known_[i].name) {
                continue;
            }
            const bool has_value = equals != std::string::npos && equals + 1 < word.size();
            if (known_[i].value != NULL && !has_value && (!is_optional(known_[i]) || equals != std::string::npos)) {
                return name + " needs a value: " + spelling(known_[i]);
            }
            // `--verbose=1` is customary for flags as well.
            given_[known_[i].name] = has_value ? word.substr(equals + 1) : "1";
            return std::string();
        }
        return "unknown option " + name + ": see --help";
    }

    std::vector<Option> known_;
    std::map<std::string, std::string> given_;
    std::vector<std::string> words_;
};

} // namespace sensedsl

#endif
