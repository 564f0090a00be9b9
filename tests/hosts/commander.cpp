// Sends commands again and again: an OpenDaVINCI application that a user would write. Compiled against the
// messages.h of either OpenDaVINCI host; commands.h, made by the test, defines COMMANDS in terms of
// SEND(type, message).
#include "messages.h"
#include "commands.h"

#include <iostream>

#ifdef OPENDAVINCI2014
#include "core/base/ConferenceClientModule.h"
#include "core/base/ModuleState.h"
typedef core::base::ConferenceClientModule Module;
typedef core::base::ModuleState::MODULE_EXITCODE ExitCode;
#else
#include "opendavinci/generated/odcore/data/dmcp/ModuleStateMessage.h"
#include "opendavinci/odcore/base/module/TimeTriggeredConferenceClientModule.h"
#include "opendavinci/odcore/data/Container.h"
#include "opendavinci/odcore/io/conference/ContainerConference.h"
typedef odcore::base::module::TimeTriggeredConferenceClientModule Module;
typedef odcore::data::dmcp::ModuleExitCodeMessage::ModuleExitCode ExitCode;
#endif

class Commander : public Module {
public:
    Commander(int argc, char **argv) : Module(argc, argv, "commander") {}

private:
    virtual void setUp() {}
    virtual void tearDown() {}

    virtual ExitCode body() {
#ifdef OPENDAVINCI2014
#define SEND(TYPE, MESSAGE)                                                                        \
    {                                                                                              \
        core::data::Container container(TYPE::ID(), MESSAGE);                                      \
        getConference().send(container);                                                           \
    }
        while (getModuleState() == core::base::ModuleState::RUNNING) {
            COMMANDS
        }
        return core::base::ModuleState::OKAY;
#else
#define SEND(TYPE, MESSAGE)                                                                        \
    {                                                                                              \
        odcore::data::Container container(MESSAGE);                                                \
        getConference().send(container);                                                           \
    }
        while (getModuleStateAndWaitForRemainingTimeInTimeslice() ==
               odcore::data::dmcp::ModuleStateMessage::RUNNING) {
            COMMANDS
        }
        return odcore::data::dmcp::ModuleExitCodeMessage::OKAY;
#endif
    }
};

int main(int argc, char **argv) {
    Commander commander(argc, argv);
    return commander.runModule();
}
