// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import io.grpc.ManagedChannel;
import io.grpc.Metadata;
import io.grpc.okhttp.OkHttpChannelBuilder;
import io.grpc.stub.MetadataUtils;
import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.concurrent.TimeUnit;

/** Opens channels to a server. */
final class Channels {
    private static final Metadata.Key<String> AUTHORIZATION =
            Metadata.Key.of("authorization", Metadata.ASCII_STRING_MARSHALLER);

    /** The most that the server takes, too; the largest answer is one frame with all boxes that a low threshold lets through. */
    private static final int LARGEST_MESSAGE_BYTES = 16 << 20;

    private Channels() {}

    static ManagedChannel open(String host, int port, String token) {
        Metadata headers = new Metadata();
        headers.put(AUTHORIZATION, "Bearer " + token);
        OkHttpChannelBuilder builder = OkHttpChannelBuilder.forAddress(host, port);
        if (loopback(host)) {
            builder.usePlaintext();
        }
        return builder
                // Otherwise a lab's proxy settings send even the loopback through the proxy.
                .proxyDetector(address -> null)
                .maxInboundMessageSize(LARGEST_MESSAGE_BYTES)
                .keepAliveTime(60, TimeUnit.SECONDS)
                .intercept(MetadataUtils.newAttachHeadersInterceptor(headers))
                .build();
    }

    /** Only there may pixels and token go unencrypted. */
    private static boolean loopback(String host) {
        try {
            return InetAddress.getByName(host).isLoopbackAddress();
        } catch (UnknownHostException e) {
            return false;
        }
    }
}
