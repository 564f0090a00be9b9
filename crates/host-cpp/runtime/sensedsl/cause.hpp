// Why a device cannot be opened, and what to do about it, in words for people.
//
// In: a path and an errno. Out: one text with the cause and the cure: the group that may open the
// device, the program that has it, the devices that are there instead. C++98 and POSIX; who holds a
// device is known on Linux alone.
#ifndef SENSEDSL_CAUSE_HPP
#define SENSEDSL_CAUSE_HPP

#include <dirent.h>
#include <errno.h>
#include <grp.h>
#include <pwd.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensedsl {

/// The names in a folder, in order; none when it cannot be read.
inline std::vector<std::string> names_in(const std::string &folder) {
    std::vector<std::string> names;
    if (DIR *open = ::opendir(folder.c_str())) {
        while (const struct dirent *entry = ::readdir(open)) {
            if (entry->d_name[0] != '.') {
                names.push_back(entry->d_name);
            }
        }
        ::closedir(open);
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// The first line of a small file; empty when there is none.
inline std::string first_line(const std::string &path) {
    std::ifstream file(path.c_str());
    std::string line;
    std::getline(file, line);
    return line;
}

/// A path without links; the path itself when it leads nowhere.
inline std::string real_path(const std::string &path) {
    char *found = ::realpath(path.c_str(), NULL);
    const std::string real = found != NULL ? found : path;
    ::free(found);
    return real;
}

/// `minicom (process 4711)` for the first other opener of a device; empty when none can be seen.
inline std::string holder_of(const std::string &path, const std::string &proc = "/proc") {
    const std::string device = real_path(path);
    const std::vector<std::string> processes = names_in(proc);
    for (size_t i = 0; i < processes.size(); ++i) {
        const std::string process = proc + "/" + processes[i];
        if (processes[i].find_first_not_of("0123456789") != std::string::npos) {
            continue;
        }
        const bool is_self = atol(processes[i].c_str()) == static_cast<long>(::getpid());
        const std::vector<std::string> files = names_in(process + "/fd");
        size_t count = 0;
        for (size_t f = 0; f < files.size(); ++f) {
            count += real_path(process + "/fd/" + files[f]) == device ? 1 : 0;
        }
        // This program has just opened it once itself, or could not.
        if (count > (is_self ? 1U : 0U)) {
            const std::string name = first_line(process + "/comm");
            return is_self ? "this program itself" : name + " (process " + processes[i] + ")";
        }
    }
    return std::string();
}

/// What serial devices there are, the ones with a name for good first.
inline std::string devices_here(const std::string &dev = "/dev") {
    std::vector<std::string> found = names_in(dev + "/serial/by-id");
    for (size_t i = 0; i < found.size(); ++i) {
        const std::string link = dev + "/serial/by-id/" + found[i];
        found[i] = real_path(link) + " (" + link + ")";
    }
    const std::vector<std::string> names = names_in(dev);
    const char *const stems[] = {"ttyACM", "ttyUSB", "cu.usb"};
    for (size_t i = 0; i < names.size(); ++i) {
        for (size_t stem = 0; stem < sizeof stems / sizeof stems[0]; ++stem) {
            const std::string path = dev + "/" + names[i];
            bool is_known = names[i].compare(0, strlen(stems[stem]), stems[stem]) != 0;
            for (size_t f = 0; f < found.size() && !is_known; ++f) {
                is_known = found[f].compare(0, path.size() + 1, path + " ") == 0;
            }
            if (!is_known) {
                found.push_back(path);
            }
        }
    }
    std::string text;
    for (size_t i = 0; i < found.size(); ++i) {
        text += (i == 0 ? "" : ", ") + found[i];
    }
    return text;
}

/// Why this user may not open the device, and what changes that.
inline std::string permission_cure(const std::string &path) {
    struct stat status;
    if (::stat(path.c_str(), &status) != 0) {
        return "permission denied";
    }
    const struct group *group = ::getgrgid(status.st_gid);
    const std::string name = group != NULL ? group->gr_name : "";
    if ((status.st_mode & S_IRGRP) == 0 || (status.st_mode & S_IWGRP) == 0 || name.empty() ||
        name == "root") {
        return "permission denied: only its owner may open it: sudo chmod a+rw " + path;
    }
    const struct passwd *user = ::getpwuid(::getuid());
    for (char **member = group->gr_mem; user != NULL && *member != NULL; ++member) {
        if (strcmp(*member, user->pw_name) == 0) {
            return "permission denied: you are in its group " + name +
                   ", but were not yet when you logged in: log in again";
        }
    }
    return "permission denied: it is for group " + name + ", and you are not in it: sudo usermod -a -G " +
           name + " " + (user != NULL ? user->pw_name : "$USER") + ", then log in again";
}

/// Cause and cure of an errno of opening a device.
inline std::string cause_of(const std::string &path, int error) {
    switch (error) {
    case EACCES:
    case EPERM:
        return permission_cure(path);
    case EBUSY: {
        const std::string holder = holder_of(path);
        return holder.empty() ? "another program has it open: end that program first"
                              : holder + " has it open: end that program first";
    }
    case ENOENT: {
        const std::string devices = devices_here();
        return devices.empty()
                   ? "there is no such device, and no other serial device either: is the board plugged in?"
                   : "there is no such device; there is " + devices;
    }
    case EIO:
    case ENXIO:
    case ENODEV:
        return "the device is gone: plug it in again";
    case EISDIR:
        return "it is a folder";
    default:
        return strerror(error);
    }
}

/// A device that cannot be opened; `what()` says why and what to do.
class OpenError : public std::runtime_error {
public:
    OpenError(const std::string &path, int error)
        : std::runtime_error("cannot open " + path + ": " + cause_of(path, error)) {}
    explicit OpenError(const std::string &text) : std::runtime_error(text) {}
};

} // namespace sensedsl

#endif
