// A connection that is polled by a thread of its own, for hosts whose own loop has another pace.
//
// In: a connection that is open. Out: its receiver is called from that thread. C++98 and POSIX.
#ifndef SENSEDSL_THREAD_HPP
#define SENSEDSL_THREAD_HPP

#include <pthread.h>

#include <stdexcept>

#include "sensedsl/connection.hpp"

namespace sensedsl {

/// Polls from `start()` to `stop()`.
class ConnectionThread {
public:
    explicit ConnectionThread(Connection &connection)
        : connection_(&connection), thread_(), is_running_(false), is_stopped_(false) {}
    ~ConnectionThread() { stop(); }

    void start() {
        if (::pthread_create(&thread_, NULL, &run, this) != 0) {
            throw std::runtime_error("cannot start a thread");
        }
        is_running_ = true;
    }

    /// Waits for the thread's end.
    void stop() {
        is_stopped_ = true;
        if (is_running_) {
            ::pthread_join(thread_, NULL);
        }
        is_running_ = false;
    }

private:
    ConnectionThread(const ConnectionThread &);
    ConnectionThread &operator=(const ConnectionThread &);

    static void *run(void *self) {
        ConnectionThread &thread = *static_cast<ConnectionThread *>(self);
        while (!thread.is_stopped_ && thread.connection_->poll(50)) {
        }
        return NULL;
    }

    Connection *connection_;
    pthread_t thread_;
    bool is_running_;
    volatile bool is_stopped_;
};

} // namespace sensedsl

#endif
