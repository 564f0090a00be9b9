// Sends two commands of design `all-types` again and again: an OpenDaVINCI application that a user would write.
// Compiled against the messages.h of either OpenDaVINCI host.
#include "messages.h"

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
        sense::robot::T7 big;
        big.setRaw(0x0123456789ABCDEFU);
        sense::robot::B4 pair;
        pair.setRaw(0, -300);
        pair.setRaw(1, 32767);
#ifdef OPENDAVINCI2014
        while (getModuleState() == core::base::ModuleState::RUNNING) {
            core::data::Container first(sense::robot::T7::ID(), big);
            core::data::Container second(sense::robot::B4::ID(), pair);
            getConference().send(first);
            getConference().send(second);
        }
        return core::base::ModuleState::OKAY;
#else
        while (getModuleStateAndWaitForRemainingTimeInTimeslice() ==
               odcore::data::dmcp::ModuleStateMessage::RUNNING) {
            odcore::data::Container first(big);
            odcore::data::Container second(pair);
            getConference().send(first);
            getConference().send(second);
        }
        return odcore::data::dmcp::ModuleExitCodeMessage::OKAY;
#endif
    }
};

int main(int argc, char **argv) {
    Commander commander(argc, argv);
    return commander.runModule();
}
